#include "planning/coverage/reachable_patches.h"

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

// Shift of the grid against round coordinates, where walls often are: otherwise a wall would lie in
// two layers of cells.
constexpr double kGridShift = 0.31;

/// Keeps the first patch of each grid cell and orientation.
class PatchGrid {
  public:
    explicit PatchGrid(double spacing_m) : spacing_m_(spacing_m) {}

    void add(const SurfacePatch& patch) {
        Eigen::Index axis = 0;
        patch.normal.cwiseAbs().maxCoeff(&axis);
        // The two sides of a thin wall are different surfaces.
        const int side = patch.normal[axis] < 0.0 ? 1 : 0;
        std::array<int, 4> key = {0, 0, 0, 2 * static_cast<int>(axis) + side};
        for (unsigned k = 0; k < 3; ++k) {
            key[k] = static_cast<int>(std::floor(patch.point[k] / spacing_m_ + kGridShift));
        }
        if (taken_.insert(key).second) patches_.push_back(patch);
    }
    [[nodiscard]] std::vector<SurfacePatch> take() && { return std::move(patches_); }

  private:
    double spacing_m_;
    std::set<std::array<int, 4>> taken_;  // grid cell and orientation
    std::vector<SurfacePatch> patches_;
};

std::vector<SurfacePatch> patchesAround(const Scene& scene, const RayCaster& rays,
                                        const Eigen::Vector3d& place,
                                        const std::vector<Eigen::Vector3d>& directions) {
    std::vector<SurfacePatch> seen;
    for (const Eigen::Vector3d& direction : directions) {
        const RayHit hit = rays.cast(place, direction);
        if (hit.object_id == 0) continue;
        const Eigen::Vector3d normal = facingNormal(scene, hit, direction).cast<double>();
        if (-normal.dot(direction) < kFlattestSightCosine) continue;
        seen.push_back({place + hit.distance * direction, normal});
    }
    return seen;
}

}  // namespace

std::vector<Eigen::Vector3d> evenPlaces(const FreeSpace& free_space, const SweptSphere& sphere,
                                        std::size_t about) {
    std::vector<Eigen::Vector3d> all;
    for (std::size_t room = 0; room < free_space.rooms().size(); ++room) {
        for (const Eigen::Vector3f& cell : sphere.cells(static_cast<int>(room))) {
            all.push_back(cell.cast<double>());
        }
    }
    std::vector<Eigen::Vector3d> places;
    const std::size_t stride = std::max<std::size_t>(1, all.size() / about);
    for (std::size_t i = stride / 2; i < all.size(); i += stride) {
        if (sphere.fits(all[i])) places.push_back(all[i]);
    }
    return places;
}

Result<std::vector<SurfacePatch>> reachablePatches(const Scene& scene, const RayCaster& rays,
                                                   const std::vector<Eigen::Vector3d>& places,
                                                   int rays_around, double spacing_m,
                                                   const JobContext& job) {
    const std::vector<Eigen::Vector3d> directions = directionsOnSphere(rays_around);
    PatchGrid grid(spacing_m);
    constexpr std::size_t kAtOnce = 32;  // positions; their patches are merged in order
    for (std::size_t begin = 0; begin < places.size(); begin += kAtOnce) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Sampling surface was cancelled.");
        const std::size_t count = std::min(kAtOnce, places.size() - begin);
        std::vector<std::vector<SurfacePatch>> seen(count);
        parallelFor(count, [&](std::size_t i) {
            seen[i] = patchesAround(scene, rays, places[begin + i], directions);
        });
        for (const auto& list : seen) {
            for (const SurfacePatch& patch : list) grid.add(patch);
        }
        job.reportItems(static_cast<int>(begin + count), static_cast<int>(places.size()));
    }
    return std::move(grid).take();
}

std::vector<SurfacePatch> thinnedOut(const std::vector<SurfacePatch>& patches, double spacing_m) {
    PatchGrid grid(spacing_m);
    for (const SurfacePatch& patch : patches) grid.add(patch);
    return std::move(grid).take();
}

}  // namespace dollytrack::planning
