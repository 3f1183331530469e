#include "planning/baselines/reachable_surface.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/visibility/facing_normal.h"
#include "planning/visibility/scanned_surfaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kPlacesAround = 400;
constexpr int kRaysAround = 20'000;  // per position: 7 cm apart at 3 m
// Shift of the grid against round coordinates, where walls often are: otherwise a wall would lie in
// two layers of cells.
constexpr double kGridShift = 0.31;

/// Positions where the camera fits, spread over the cells of all rooms.
std::vector<Eigen::Vector3d> evenPlaces(const BaselineScene& scene) {
    std::vector<Eigen::Vector3d> all;
    for (std::size_t room = 0; room < scene.free_space->rooms().size(); ++room) {
        for (const Eigen::Vector3f& cell : scene.sphere->cells(static_cast<int>(room))) {
            all.push_back(cell.cast<double>());
        }
    }
    std::vector<Eigen::Vector3d> places;
    const std::size_t stride = std::max<std::size_t>(1, all.size() / kPlacesAround);
    for (std::size_t i = stride / 2; i < all.size(); i += stride) {
        if (scene.sphere->fits(all[i])) places.push_back(all[i]);
    }
    return places;
}

std::vector<SurfacePatch> seenFrom(const BaselineScene& scene, const Eigen::Vector3d& place,
                                   const std::vector<Eigen::Vector3d>& directions) {
    std::vector<SurfacePatch> seen;
    for (const Eigen::Vector3d& direction : directions) {
        const RayHit hit = scene.rays->cast(place, direction);
        if (hit.object_id == 0) continue;
        const Eigen::Vector3d normal = facingNormal(*scene.scene, hit, direction).cast<double>();
        if (-normal.dot(direction) < kFlattestSightCosine) continue;
        seen.push_back({place + hit.distance * direction, normal});
    }
    return seen;
}

}  // namespace

Result<std::vector<SurfacePatch>> reachableSurface(const BaselineScene& scene, double spacing_m,
                                                   const JobContext& job) {
    const std::vector<Eigen::Vector3d> places = evenPlaces(scene);
    const std::vector<Eigen::Vector3d> directions = directionsOnSphere(kRaysAround);
    std::vector<SurfacePatch> samples;
    std::set<std::array<int, 4>> taken;  // grid cell and orientation
    constexpr std::size_t kAtOnce = 32;  // positions; their samples are merged in order
    for (std::size_t begin = 0; begin < places.size(); begin += kAtOnce) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "The comparison was stopped.");
        const std::size_t count = std::min(kAtOnce, places.size() - begin);
        std::vector<std::vector<SurfacePatch>> seen(count);
        parallelFor(count, [&](std::size_t i) {
            seen[i] = seenFrom(scene, places[begin + i], directions);
        });
        for (const auto& list : seen) {
            for (const SurfacePatch& patch : list) {
                Eigen::Index axis = 0;
                patch.normal.cwiseAbs().maxCoeff(&axis);
                // The two sides of a thin wall are different surfaces.
                const int side = patch.normal[axis] < 0.0 ? 1 : 0;
                std::array<int, 4> key = {0, 0, 0, 2 * static_cast<int>(axis) + side};
                for (unsigned k = 0; k < 3; ++k) {
                    key[k] = static_cast<int>(std::floor(patch.point[k] / spacing_m + kGridShift));
                }
                if (taken.insert(key).second) samples.push_back(patch);
            }
        }
        job.reportItems(static_cast<int>(begin + count), static_cast<int>(places.size()));
    }
    return samples;
}

}  // namespace dollytrack::planning
