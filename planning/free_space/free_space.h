#pragma once

#include "engine/camera/camera_params.h"
#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/free_space/opening_report.h"
#include "planning/free_space_params.h"

#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace octomap {
class OcTree;
}

namespace dollytrack::planning {

class SurfaceMap;

/// Free: air connected with a room. Unknown: outside the building, inside furniture, or not covered
/// by a scan.
enum class CellState { Free, Occupied, Unknown };

/// A connected region of cells in whose centres the camera sphere fits.
struct Room {
    int component = 0;                                 // index in rooms()
    Eigen::AlignedBox3d box;                           // around its cells, m
    double volume_m3 = 0.0;                            // of the positions of the camera's centre
    double floor_area_m2 = 0.0;                        // footprint of those positions
    Eigen::Vector3d sample = Eigen::Vector3d::Zero();  // cell centre with the largest clearance
};

/// A leaf of the octree, for drawing.
struct FreeSpaceLeaf {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double size_m = 0.0;                   // edge length
    int level = 0;                         // 0: the smallest cells; each level doubles the edge
    CellState state = CellState::Unknown;  // never Unknown: unknown space has no leaf
};

/// Map of a scene: where a camera can be, a lower bound of its clearance, and connected regions.
/// World frame, metres. Immutable; safe to call from many threads; does not keep the scene. The
/// same scene and parameters give the same map, bit by bit, with any number of threads.
class FreeSpace {
  public:
    /// Maps `scene.room_bounds`. Logs a warning and uses coarser cells if the scene is too large.
    /// Errors: BadInput if no room holds the camera sphere, the bounds are unusable or a parameter
    /// is out of range; Cancelled.
    static Result<FreeSpace> build(const Scene& scene, const RayCaster& rays,
                                   const CameraParams& camera, const FreeSpaceParams& params,
                                   const JobContext& job = {});

    /// Builds the map from a surface map, which maps for other camera radii can share.
    static Result<FreeSpace> buildOver(std::shared_ptr<const SurfaceMap> surfaces,
                                       const Scene& scene, const RayCaster& rays,
                                       const CameraParams& camera, const JobContext& job = {});

    /// Incremental build for a scene in which only the objects `moved` (ids, ascending) differ in
    /// pose from the scene of `before`. `surfaces` is the result of SurfaceMap::afterMoves(). Gives
    /// the same map as buildOver().
    static Result<FreeSpace> afterMoves(const FreeSpace& before,
                                        std::shared_ptr<const SurfaceMap> surfaces,
                                        const std::vector<int>& moved, const Scene& scene,
                                        const RayCaster& rays, const CameraParams& camera,
                                        const JobContext& job = {});

    ~FreeSpace();
    FreeSpace(FreeSpace&&) noexcept;
    FreeSpace& operator=(FreeSpace&&) noexcept;

    /// State of the cell at a point; Unknown outside the map.
    [[nodiscard]] CellState stateAt(const Eigen::Vector3d& point) const;

    /// Edge of the octree leaf at a point, m; of a smallest cell outside the map.
    [[nodiscard]] double cellSizeAt(const Eigen::Vector3d& point) const;

    /// Lower bound of the distance to the nearest surface of the scene, m; 0 where the cell is not
    /// free. It is less than 3.5 cells too low, up to the cut-off of 180 cells, if no surface lies
    /// outside the map. Costs one array look-up.
    [[nodiscard]] double clearanceLowerBound(const Eigen::Vector3d& point) const;

    /// Index into rooms() of the cell at a point; -1 outside all rooms, including cells in whose
    /// centre the sphere does not fit.
    [[nodiscard]] int componentAt(const Eigen::Vector3d& point) const;

    /// Whether both points lie in the same free leaf, so that the segment between them is in free
    /// space.
    [[nodiscard]] bool inOneFreeLeaf(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

    /// At least one room, the largest first.
    [[nodiscard]] const std::vector<Room>& rooms() const;

    /// Centres of a room's cells, for sampling, in a fixed order. Subsampled evenly in rooms of
    /// more than about half a million cells.
    [[nodiscard]] const std::vector<Eigen::Vector3f>& cells(int component) const;

    /// OctoMap tree, built at the first call. Free leaves have the lowest occupancy, occupied
    /// leaves the highest; unknown space has no node.
    [[nodiscard]] const octomap::OcTree& octree() const;

    /// Calls `visit` for every free and occupied leaf. Builds the OctoMap tree if necessary.
    void visitLeaves(const std::function<void(const FreeSpaceLeaf&)>& visit) const;

    /// Bounding box of the map: the room bounds with a rim of one cell, on whole cells, m.
    [[nodiscard]] const Eigen::AlignedBox3d& bounds() const;

    /// Edge of the smallest cells, m; larger than requested if the scene is too large.
    [[nodiscard]] double resolution_m() const;

    /// For a scan, the share of the air inside the building that was scanned, 0..1; the rest is
    /// unknown. Empty for a modelled scene.
    [[nodiscard]] std::optional<double> scannedShare() const;

    /// Openings of the rooms. Computed at the first call.
    [[nodiscard]] const OpeningReport& openingReport() const;

  private:
    struct Impl;
    struct Moved;
    static Result<FreeSpace> make(std::shared_ptr<const SurfaceMap> surfaces, const Moved* moved,
                                  const Scene& scene, const RayCaster& rays,
                                  const CameraParams& camera, const JobContext& job);
    explicit FreeSpace(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::planning
