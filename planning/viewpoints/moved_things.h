#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;
class ViewEstimator;

/// All that the rays of an estimate of this object can pass through at its own place, m.
Eigen::AlignedBox3d reachedBox(const ViewEstimator& views, int object_id);

/// Objects that stand elsewhere than when something was looked at.
class MovedThings {
  public:
    /// Objects and the boxes around their corners, where they were and where they are.
    void add(const std::vector<int>& objects, const std::vector<Eigen::AlignedBox3d>& boxes);
    void clear();

    [[nodiscard]] bool empty() const { return objects_.empty(); }
    [[nodiscard]] const std::vector<int>& objects() const { return objects_; }  // rising
    [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& boxes() const { return boxes_; }
    [[nodiscard]] bool isOne(int object_id) const;

    /// Whether one is, or was, nearer to the point than that.
    [[nodiscard]] bool near(const Eigen::Vector3d& point, double distance_m) const;
    /// Whether one may meet, or have met, a ray from the point to anywhere in the box. Never false
    /// when one does.
    [[nodiscard]] bool cross(const Eigen::Vector3d& from, const Eigen::AlignedBox3d& target) const;
    [[nodiscard]] bool meet(const Eigen::AlignedBox3d& box) const;

  private:
    std::vector<int> objects_;
    std::vector<Eigen::AlignedBox3d> boxes_;
};

/// All that a search asked of the scene and of its map.
struct LookedAt {
    struct Place {
        Eigen::Vector3d position;
        bool looked = false;  // along rays to the target; else whether the camera fits there only
    };
    std::vector<Place> places;
    Eigen::AlignedBox3d target;                                // see reachedBox()
    Eigen::Vector3d sampled_around = Eigen::Vector3d::Zero();  // places came from the rooms' cells
    double sampled_within_m = -1.0;                            // nearer to this than that; below 0:
                                                               // none did
};

/// Where the maps of two scenes differ, as far as a search can tell.
class MapChange {
  public:
    /// The region, where it restricts anything, decides which cells there are to sample from.
    /// References must outlive it.
    MapChange(const FreeSpace& before, const AllowedRegion* region_before, const FreeSpace& now,
              const AllowedRegion* region_now);

    /// Whether the cell at a place has another state or belongs to a room of another number.
    [[nodiscard]] bool at(const Eigen::Vector3d& place) const;
    /// Whether the rooms' cells to sample from differ nearer to a point than that.
    [[nodiscard]] bool within(const Eigen::Vector3d& center, double distance_m) const;

  private:
    const FreeSpace& before_;
    const FreeSpace& now_;
    std::vector<Eigen::Vector3f> cells_;  // in one of the maps only
};

/// Whether a search might find something else now. Never false when it would.
[[nodiscard]] bool isTouched(const LookedAt& looked, const MovedThings& moved, const MapChange& map,
                             double camera_radius_m);

}  // namespace dollytrack::planning
