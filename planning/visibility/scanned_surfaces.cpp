#include "planning/visibility/scanned_surfaces.h"

#include "engine/io/pointcloud/unseen_floor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kFineEdge_m = 0.2;    // longest edge of a fine triangle
constexpr double kFineShare = 0.9;     // least share of the surface area in fine triangles
constexpr std::size_t kFewest = 2000;  // least number of triangles: a small model may be as fine
constexpr double kFacesInwards = 0.1;  // mean cosine between normals and the direction to the
                                       // centre

bool isUnseenFloor(const Object& object) {
    return object.name == kUnseenFloor;
}

}  // namespace

std::vector<Eigen::Vector3d> directionsOnSphere(int count) {
    std::vector<Eigen::Vector3d> all;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double turn = 2.0 * std::numbers::pi * std::numbers::phi * i;
        const double across = std::sqrt(1.0 - z * z);
        all.emplace_back(across * std::cos(turn), across * std::sin(turn), z);
    }
    return all;
}

ScannedSurfaces::ScannedSurfaces(const Scene& scene) : scene_(&scene) {
    double area = 0.0;
    double fine = 0.0;
    double inwards = 0.0;
    const Eigen::Vector3f middle = scene.room_bounds.center().cast<float>();
    for (const Object& object : scene.objects) {
        if (isUnseenFloor(object)) continue;
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            const Triangle& triangle = scene.triangles[object.first_triangle + t];
            const Eigen::Vector3f& a = scene.positions[triangle[0]];
            const Eigen::Vector3f& b = scene.positions[triangle[1]];
            const Eigen::Vector3f& c = scene.positions[triangle[2]];
            const Eigen::Vector3f across = (b - a).cross(c - a);
            const double size = across.norm();
            const double edge = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
            area += size;
            if (edge <= kFineEdge_m) fine += size;
            inwards += across.dot((middle - a).stableNormalized());
        }
    }
    is_scan_ = std::ranges::any_of(scene.objects, isUnseenFloor) ||
               (scene.triangles.size() >= kFewest && fine >= kFineShare * area);
    fronts_known_ = inwards >= kFacesInwards * area;
}

ScannedSurfaces::HitSide ScannedSurfaces::hitSide(const RayHit& hit,
                                                  const Eigen::Vector3d& direction) const {
    if (hit.object_id == 0 || isUnseenFloor(scene_->object(hit.object_id))) return HitSide::Nothing;
    if (!fronts_known_) return HitSide::Front;
    const Triangle& triangle = scene_->triangles[hit.triangle];
    const Eigen::Vector3f& a = scene_->positions[triangle[0]];
    const Eigen::Vector3f across =
        (scene_->positions[triangle[1]] - a).cross(scene_->positions[triangle[2]] - a);
    return across.cast<double>().dot(direction) <= 0.0 ? HitSide::Front : HitSide::Back;
}

}  // namespace dollytrack::planning
