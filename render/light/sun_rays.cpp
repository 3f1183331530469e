#include "render/light/sun_rays.h"

#include <algorithm>
#include <limits>

namespace dollytrack::render {
namespace {

constexpr int kMostSheetsToSun = 64;  // of glass, windows or holes along one ray

/// Distance along the ray to where it finally leaves the box; negative if it misses the box.
double exitFrom(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                const Eigen::Vector3d& way) {
    double enters = 0.0;
    double leaves = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.min()[axis] - from[axis];
        const double high = box.max()[axis] - from[axis];
        if (way[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return -1.0;
            continue;
        }
        enters = std::max(enters, std::min(low / way[axis], high / way[axis]));
        leaves = std::min(leaves, std::max(low / way[axis], high / way[axis]));
    }
    return leaves >= enters ? leaves : -1.0;
}

}  // namespace

std::vector<bool> wholeWindows(const Scene& scene) {
    const std::vector<Surface> kinds = surfaceKinds(scene);
    const std::vector<bool> outside = showsOutside(scene);
    std::vector<bool> whole;
    for (const Object& object : scene.objects) {
        const auto first = scene.triangle_material.begin() + object.first_triangle;
        whole.push_back(outside[object.id - 1] &&
                        std::none_of(first, first + object.triangle_count, [&](std::uint32_t of) {
                            return kinds[of] == Surface::Glass;
                        }));
    }
    return whole;
}

SunRays::SunRays(const Scene& scene, const RayCaster& rays, const TracedSurface& surface,
                 const SunLight& sun)
    : scene_(scene),
      rays_(rays),
      surface_(surface),
      sun_(sun),
      whole_windows_(sun.shines() ? wholeWindows(scene) : std::vector<bool>()) {}

double SunRays::share(Eigen::Vector3d from, const Eigen::Vector3d& way) const {
    double free = exitFrom(sun_.shades, from, way);
    double share = 1.0;
    for (int sheet = 0; sheet < kMostSheetsToSun && share > 0.0; ++sheet) {
        if (free <= 0.0) return share;
        const RayHit hit = rays_.cast(from, way, free);
        if (hit.object_id == 0) return share;
        const SurfacePoint point = surface_.at(from, way, hit);
        if (!point.hole && !whole_windows_[hit.object_id - 1]) {
            if (point.kind != Surface::Glass) return 0.0;
            if (!sendsDaylight(scene_.object(hit.object_id))) {
                share *= (1.0 - sheetReflectance(-way.dot(point.face))) * (1.0 - point.opacity);
            }
        }
        const Eigen::Vector3d next = liftedOff(point, way);
        free -= (next - from).dot(way);
        from = next;
    }
    return 0.0;
}

}  // namespace dollytrack::render
