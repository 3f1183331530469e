#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/free_space/enclosure.h"
#include "planning/free_space/voxel_grid.h"
#include "planning/free_space/voxelize.h"
#include "planning/free_space_params.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dollytrack::planning {

/// The part of the map that does not depend on the camera: cells with surfaces, distances to them,
/// and the enclosure classification. World frame, metres. Immutable apart from cached results; safe
/// to call from many threads; does not keep the scene.
class SurfaceMap {
  public:
    /// Maps `scene.room_bounds`. Logs a warning and uses coarser cells if the scene is too large.
    /// Errors: BadInput if the bounds are unusable or too far from the origin, or the cell size is
    /// out of range; Cancelled.
    static Result<SurfaceMap> build(const Scene& scene, const FreeSpaceParams& params,
                                    const JobContext& job = {});

    /// Incremental build for a scene in which only the objects `moved` (ids, ascending) differ in
    /// pose from the scene of `before`. Gives the same map as build(), which is called if the grid
    /// differs.
    static Result<SurfaceMap> afterMoves(const SurfaceMap& before, const Scene& scene,
                                         const std::vector<int>& moved,
                                         const FreeSpaceParams& params, const JobContext& job = {});

    ~SurfaceMap();
    SurfaceMap(SurfaceMap&&) noexcept;
    SurfaceMap& operator=(SurfaceMap&&) noexcept;

    [[nodiscard]] const VoxelGrid& grid() const;
    [[nodiscard]] const SurfaceCells& surfaces() const;

    /// Squared gaps by cell; see squaredGaps().
    [[nodiscard]] const std::vector<std::uint16_t>& gaps() const;

    /// Number of cells without surface.
    [[nodiscard]] std::int64_t airCells() const;

    /// By cell: 1 if inside by this rule (see Enclosure). Computed at the first call for a rule;
    /// other threads wait for it.
    [[nodiscard]] const std::vector<std::uint8_t>& inside(EnclosureRule rule) const;

  private:
    struct Impl;
    static Result<std::unique_ptr<Impl>> begin(const Scene& scene, const FreeSpaceParams& params);
    explicit SurfaceMap(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::planning
