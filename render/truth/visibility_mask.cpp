#include "render/truth/visibility_mask.h"

#include "engine/camera/intrinsics.h"
#include "engine/geometry/ray_caster.h"
#include "engine/math/pose.h"

namespace dollytrack::render {
namespace {

constexpr double kSameSurface_m = 0.002;
constexpr double kRounding = 1e-5;  // relative to depth: depth images have single precision

}  // namespace

std::vector<PixelVisibility> visibilityFrom(const RayCaster& rays, const Pose& camera,
                                            const Intrinsics& lens, double near_m,
                                            std::span<const Eigen::Vector3d> places,
                                            const std::vector<bool>& nothing) {
    std::vector<PixelVisibility> sight(places.size(), PixelVisibility::Nothing);
    std::vector<RayCaster::BundleRay> bundle;
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (nothing[i]) continue;
        const Eigen::Vector3d p = camera.toCamera(places[i]);
        sight[i] = PixelVisibility::Outside;
        if (p.z() < near_m) continue;
        const Eigen::Vector2d at = lens.project(p);
        if (at.x() < 0.0 || at.y() < 0.0 || at.x() >= lens.width || at.y() >= lens.height) continue;
        // Directions have z = 1 in the camera frame, so ray lengths are planar depths.
        const double until = p.z() - kSameSurface_m - kRounding * p.z();
        bundle.push_back({camera.rotation * (p / p.z()), static_cast<float>(until)});
        asked.push_back(i);
    }
    std::vector<RayHit> hits;
    rays.castBundle(camera.position, bundle, near_m, hits);
    for (std::size_t k = 0; k < asked.size(); ++k) {
        sight[asked[k]] =
            hits[k].object_id == 0 ? PixelVisibility::Seen : PixelVisibility::Occluded;
    }
    return sight;
}

}  // namespace dollytrack::render
