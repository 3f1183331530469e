#include "planning/free_space/surface_map.h"

#include "engine/core/log.h"
#include "planning/free_space/distance_field.h"
#include "planning/free_space/enclosure_rays.h"
#include "planning/free_space/floor_plan.h"
#include "planning/free_space/mapping_messages.h"
#include "planning/free_space/octree.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <string>

namespace dollytrack::planning {
namespace {

// Building a map of 67 million cells takes a few seconds and up to 0.7 GB.
constexpr std::size_t kMaxCells = std::size_t{1} << 26U;
constexpr std::size_t kEnclosureRules = 3;

}  // namespace

struct SurfaceMap::Impl {
    VoxelGrid grid;
    SurfaceCells surfaces;
    std::vector<std::uint16_t> gaps;
    std::vector<std::uint8_t> ray_bits;
    FloorPlan plan;
    std::int64_t air = 0;
    std::mutex asked;
    std::array<std::unique_ptr<const Enclosure>, kEnclosureRules>
        enclosures;  // by rule; null until asked for

    [[nodiscard]] EnclosureInput seen() const { return {grid, surfaces.cells, ray_bits}; }
};

SurfaceMap::SurfaceMap(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SurfaceMap::~SurfaceMap() = default;
SurfaceMap::SurfaceMap(SurfaceMap&&) noexcept = default;
SurfaceMap& SurfaceMap::operator=(SurfaceMap&&) noexcept = default;

/// Checks the bounds and sets the grid only.
Result<std::unique_ptr<SurfaceMap::Impl>> SurfaceMap::begin(const Scene& scene,
                                                            const FreeSpaceParams& params) {
    if (!(params.octree_resolution_m >= 0.01 && params.octree_resolution_m <= 0.5)) {
        return fail(ErrorCode::BadInput, "must be 0.01 to 0.5 m", "octree_resolution_m");
    }
    const Eigen::AlignedBox3d& room = scene.room_bounds;
    if (!room.min().allFinite() || !room.max().allFinite() || room.isEmpty() ||
        room.sizes().maxCoeff() > 1e4) {
        return fail(ErrorCode::BadInput,
                    "the scene's bounds are empty or too large; check its units", scene.name);
    }
    auto impl = std::make_unique<Impl>();
    impl->grid = makeVoxelGrid(room, params.octree_resolution_m, kMaxCells);
    const VoxelGrid& grid = impl->grid;
    if (!fitsOctree(grid)) {
        return fail(ErrorCode::BadInput,
                    "the room is too far from the origin for its map; move it to within " +
                        inMetres(32000 * grid.resolution_m) + " or raise octree_resolution_m",
                    scene.name);
    }
    if (grid.resolution_m > params.octree_resolution_m) {
        log::warn("planning", "the scene is too large for cells of " +
                                  inMetres(params.octree_resolution_m) + ": it is mapped with " +
                                  inMetres(grid.resolution_m) +
                                  "; set octree_resolution_m, or check the scene's units");
    }
    return impl;
}

Result<SurfaceMap> SurfaceMap::build(const Scene& scene, const FreeSpaceParams& params,
                                     const JobContext& job) {
    auto begun = begin(scene, params);
    if (!begun) return tl::unexpected(std::move(begun.error()));
    std::unique_ptr<Impl>& impl = *begun;
    const VoxelGrid& grid = impl->grid;
    impl->surfaces = voxelize(scene, grid, job);
    if (job.cancelled()) return mappingCancelled();
    job.report(0.4);
    impl->gaps = squaredGaps(grid, impl->surfaces.cells, job);
    if (job.cancelled()) return mappingCancelled();
    job.report(0.7);
    impl->ray_bits = castEnclosureRays(grid, impl->surfaces.cells, job);
    if (job.cancelled()) return mappingCancelled();
    impl->plan = drawFloorPlan(grid, impl->surfaces.cells);
    impl->air = std::ranges::count(impl->surfaces.cells, std::uint8_t{0});
    job.report(1.0);
    return SurfaceMap(std::move(impl));
}

Result<SurfaceMap> SurfaceMap::afterMoves(const SurfaceMap& before, const Scene& scene,
                                          const std::vector<int>& moved,
                                          const FreeSpaceParams& params, const JobContext& job) {
    auto begun = begin(scene, params);
    if (!begun) return tl::unexpected(std::move(begun.error()));
    std::unique_ptr<Impl>& impl = *begun;
    const VoxelGrid& grid = impl->grid;
    Impl& old = *before.impl_;
    if (!(grid == old.grid)) return build(scene, params, job);

    std::vector<CellBox> changed;
    impl->surfaces = voxelizeMoved(old.surfaces, scene, grid, moved, changed, job);
    const std::vector<std::uint8_t>& cells = impl->surfaces.cells;
    impl->gaps = squaredGapsAfter(old.gaps, changed, grid, cells, job);
    if (job.cancelled()) return mappingCancelled();
    job.report(0.5);
    impl->ray_bits =
        updateEnclosureRays(old.ray_bits, old.surfaces.cells, grid, cells, changed, job);
    if (job.cancelled()) return mappingCancelled();
    impl->plan = drawFloorPlan(grid, cells);
    impl->air = std::ranges::count(cells, std::uint8_t{0});
    if (impl->plan == old.plan) {
        const std::lock_guard lock(old.asked);
        for (std::size_t rule = 0; rule < kEnclosureRules; ++rule) {
            if (!old.enclosures[rule]) continue;
            impl->enclosures[rule] = std::make_unique<const Enclosure>(
                *old.enclosures[rule], old.seen(), impl->seen(), impl->plan, changed);
        }
    }
    job.report(1.0);
    return SurfaceMap(std::move(impl));
}

const VoxelGrid& SurfaceMap::grid() const {
    return impl_->grid;
}
const SurfaceCells& SurfaceMap::surfaces() const {
    return impl_->surfaces;
}
const std::vector<std::uint16_t>& SurfaceMap::gaps() const {
    return impl_->gaps;
}
std::int64_t SurfaceMap::airCells() const {
    return impl_->air;
}

const std::vector<std::uint8_t>& SurfaceMap::inside(EnclosureRule rule) const {
    const std::lock_guard lock(impl_->asked);
    std::unique_ptr<const Enclosure>& found = impl_->enclosures.at(static_cast<std::size_t>(rule));
    if (!found) found = std::make_unique<const Enclosure>(impl_->seen(), impl_->plan, rule);
    return found->cells();
}

}  // namespace dollytrack::planning
