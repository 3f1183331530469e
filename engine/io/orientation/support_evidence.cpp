#include "engine/io/orientation/support_evidence.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <limits>

namespace dollytrack {
namespace {

constexpr std::size_t kMostSupportTriangles = 5'000'000;
constexpr int kProbes = 4;
constexpr int kOwnSurfaces = 8;

/// Four extreme points among the lowest vertices, one per diagonal direction.
std::array<Eigen::Vector3d, kProbes> lowestPoints(const Scene& scene, const Object& object,
                                                  int axis, double sign, double contact) {
    const auto first = scene.positions.begin() + object.first_vertex;
    const auto last = first + object.vertex_count;
    double lowest = std::numeric_limits<double>::infinity();
    for (auto p = first; p != last; ++p) {
        lowest = std::min(lowest, sign * static_cast<double>((*p)[axis]));
    }
    std::array<Eigen::Vector3d, kProbes> points{};
    std::array<double, kProbes> furthest{};
    furthest.fill(-std::numeric_limits<double>::infinity());
    for (auto p = first; p != last; ++p) {
        if (sign * static_cast<double>((*p)[axis]) > lowest + 0.5 * contact) continue;
        const auto a = static_cast<double>((*p)[(axis + 1) % 3]);
        const auto b = static_cast<double>((*p)[(axis + 2) % 3]);
        const std::array<double, kProbes> out = {a + b, a - b, b - a, -a - b};
        for (std::size_t i = 0; i < kProbes; ++i) {
            if (out[i] <= furthest[i]) continue;
            furthest[i] = out[i];
            points[i] = p->cast<double>();
        }
    }
    return points;
}

/// Whether another object's surface lies within `contact` above or below a point.
bool restsAt(const RayCaster& caster, int object_id, const Eigen::Vector3d& point,
             const Eigen::Vector3d& down, double contact) {
    const Eigen::Vector3d origin = point - contact * down;
    double from = 0.0;
    for (int i = 0; i < kOwnSurfaces; ++i) {
        const RayHit hit = caster.cast(origin, down, 2.0 * contact, from);
        if (hit.object_id == 0) return false;
        if (hit.object_id != object_id) return true;
        from = hit.distance * (1.0 + 1e-6) + 1e-6 * contact;
    }
    return false;
}

}  // namespace

std::vector<SideSupport> measureSupport(const Scene& scene, double contact) {
    std::vector<SideSupport> all(scene.objects.size(), SideSupport{});
    if (scene.triangles.size() > kMostSupportTriangles || scene.objects.size() < 2) return all;
    const RayCaster caster(scene);
    parallelFor(all.size(), [&](std::size_t i) {
        const Object& object = scene.objects[i];
        if (object.vertex_count == 0) return;
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool negative : {false, true}) {
                const double sign = negative ? -1.0 : 1.0;
                const Eigen::Vector3d down = -sign * Eigen::Vector3d::Unit(axis);
                int rests = 0;
                for (const auto& point : lowestPoints(scene, object, axis, sign, contact)) {
                    rests += restsAt(caster, object.id, point, down, contact);
                }
                all[i][sideIndex(axis, negative)] = static_cast<float>(rests) / kProbes;
            }
        }
    });
    return all;
}

}  // namespace dollytrack
