#pragma once

#include "engine/camera/camera_params.h"
#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/free_space/free_space_params.h"
#include "planning/free_space/leak_report.h"

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

/// Free is air that belongs to a room; outside the building, inside furniture and where a scan
/// shows nothing is unknown.
enum class CellState { Free, Occupied, Unknown };

/// Places that the camera's sphere can reach from one another.
struct Room {
    int component = 0;                                 // index in rooms()
    Eigen::AlignedBox3d box;                           // of its cells, m
    double volume_m3 = 0.0;                            // where the camera's centre can be
    double floor_area_m2 = 0.0;                        // of the footprint of that
    Eigen::Vector3d sample = Eigen::Vector3d::Zero();  // a place with the largest clearance
};

/// A leaf of the octree, for drawing.
struct FreeSpaceLeaf {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double size_m = 0.0;                   // edge
    int level = 0;                         // 0: the smallest cells; one more doubles the edge
    CellState state = CellState::Unknown;  // never Unknown: those have no leaf
};

/// The map of a scene: where a camera can be, how far it is from the nearest surface there, and
/// which places it can reach. World frame, metres. Constant once built; may be asked from many
/// threads; the scene may go. The same scene and parameters give the same map, bit by bit, with any
/// number of threads.
class FreeSpace {
  public:
    /// Maps `scene.room_bounds`. BadInput when no room in it holds the camera's sphere, when the
    /// bounds are unusable or a parameter is out of range; Cancelled when the job is. Too large a
    /// scene gets coarser cells and a warning.
    static Result<FreeSpace> build(const Scene& scene, const RayCaster& rays,
                                   const CameraParams& camera, const FreeSpaceParams& params,
                                   const JobContext& job = {});

    /// The same from surfaces that were mapped before, which another camera may share.
    static Result<FreeSpace> buildOver(std::shared_ptr<const SurfaceMap> surfaces,
                                       const Scene& scene, const RayCaster& rays,
                                       const CameraParams& camera, const JobContext& job = {});

    /// The same from the map `before` of a scene in which only these objects (ids, rising) stood
    /// elsewhere, of whose surfaces these are SurfaceMap::afterMoves().
    static Result<FreeSpace> afterMoves(const FreeSpace& before,
                                        std::shared_ptr<const SurfaceMap> surfaces,
                                        const std::vector<int>& moved, const Scene& scene,
                                        const RayCaster& rays, const CameraParams& camera,
                                        const JobContext& job = {});

    ~FreeSpace();
    FreeSpace(FreeSpace&&) noexcept;
    FreeSpace& operator=(FreeSpace&&) noexcept;

    /// Unknown outside the map.
    [[nodiscard]] CellState stateAt(const Eigen::Vector3d& point) const;

    /// Edge of the octree's leaf at a point, m; of a smallest cell outside the map.
    [[nodiscard]] double cellSizeAt(const Eigen::Vector3d& point) const;

    /// Never more than the distance to the nearest surface of the scene, m; 0 where not free. It
    /// falls short by less than 3.5 cells where it is below its cut-off of 180 cells and nothing
    /// lies outside the map. A look-up in an array.
    [[nodiscard]] double clearanceLowerBound(const Eigen::Vector3d& point) const;

    /// The room (index into rooms()) of the cell at a point; -1 where the sphere does not fit in
    /// the cell's middle, or where there is no room.
    [[nodiscard]] int componentAt(const Eigen::Vector3d& point) const;

    /// Whether both points lie in one free leaf, so that the segment between them is free, too.
    [[nodiscard]] bool inOneFreeLeaf(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

    /// At least one, largest first.
    [[nodiscard]] const std::vector<Room>& rooms() const;

    /// Centres of a room's cells, to sample from; in a fixed order. Thinned evenly in rooms of more
    /// than half a million cells.
    [[nodiscard]] const std::vector<Eigen::Vector3f>& cells(int component) const;

    /// Free leaves have the lowest occupancy, occupied ones the highest; unknown has no node. Grown
    /// when first asked for.
    [[nodiscard]] const octomap::OcTree& octree() const;

    /// Calls `visit` for every free and occupied leaf.
    void visitLeaves(const std::function<void(const FreeSpaceLeaf&)>& visit) const;

    /// The box of the map: the room's bounds and a rim of one cell, on whole cells.
    [[nodiscard]] const Eigen::AlignedBox3d& bounds() const;

    /// Edge of the smallest cells, m; more than asked for where the scene is too large.
    [[nodiscard]] double resolution_m() const;

    /// Of a scan: the share of the air inside the building that was scanned, 0..1. The rest is
    /// unknown. Empty for a modelled scene.
    [[nodiscard]] std::optional<double> scannedShare() const;

    /// Where rooms are open.
    [[nodiscard]] const LeakReport& leaks() const;

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
