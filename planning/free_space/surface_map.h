#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/free_space/enclosure.h"
#include "planning/free_space/free_space_params.h"
#include "planning/free_space/voxel_grid.h"
#include "planning/free_space/voxelize.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dollytrack::planning {

/// What the scene and the size of the cells decide alone, whatever the camera: cells with surfaces,
/// gaps to them, and what they enclose. World frame, metres. Constant once built, but for answers
/// that are kept; may be asked from many threads; the scene may go.
class SurfaceMap {
  public:
    /// Maps `scene.room_bounds`. BadInput when the bounds are unusable, too far from the origin, or
    /// the cell size is out of range; Cancelled when the job is. Too large a scene gets coarser
    /// cells and a warning.
    static Result<SurfaceMap> build(const Scene& scene, const FreeSpaceParams& params,
                                    const JobContext& job = {});

    /// The map of a scene in which only these objects (ids, rising) stand elsewhere than in that of
    /// `before`, in rooms of the same bounds: the one that build() makes, with only that made anew
    /// which they can have changed.
    static Result<SurfaceMap> afterMoves(const SurfaceMap& before, const Scene& scene,
                                         const std::vector<int>& moved,
                                         const FreeSpaceParams& params, const JobContext& job = {});

    ~SurfaceMap();
    SurfaceMap(SurfaceMap&&) noexcept;
    SurfaceMap& operator=(SurfaceMap&&) noexcept;

    [[nodiscard]] const VoxelGrid& grid() const;
    [[nodiscard]] const SurfaceCells& surfaces() const;

    /// As squaredGaps() makes them.
    [[nodiscard]] const std::vector<std::uint16_t>& gaps() const;

    /// Cells without surface.
    [[nodiscard]] std::int64_t airCells() const;

    /// What an Enclosure has inside, 1 or 0. The first who asks for a rule waits for it.
    [[nodiscard]] const std::vector<std::uint8_t>& inside(EnclosureRule rule) const;

  private:
    struct Impl;
    static Result<std::unique_ptr<Impl>> begin(const Scene& scene, const FreeSpaceParams& params);
    explicit SurfaceMap(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::planning
