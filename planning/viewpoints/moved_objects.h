#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;
class ViewEstimator;

/// Box around an object, with a margin, in which all rays cast for its estimate end; world, m.
Eigen::AlignedBox3d reachedBox(const ViewEstimator& views, int object_id);

/// Objects that moved since cached results were computed, with bounding boxes of where they were
/// and are.
class MovedObjects {
  public:
    /// Adds objects and the bounding boxes of their old and new poses.
    void add(const std::vector<int>& objects, const std::vector<Eigen::AlignedBox3d>& boxes);
    void clear();

    [[nodiscard]] bool empty() const { return objects_.empty(); }
    [[nodiscard]] const std::vector<int>& objects() const { return objects_; }  // ascending
    [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& boxes() const { return boxes_; }
    [[nodiscard]] bool isOne(int object_id) const;

    /// Whether an old or new box is within `distance_m` of the point.
    [[nodiscard]] bool near(const Eigen::Vector3d& point, double distance_m) const;
    /// Whether an old or new box may intersect a ray from the point to the target box.
    /// Conservative: never false if one does.
    [[nodiscard]] bool cross(const Eigen::Vector3d& from, const Eigen::AlignedBox3d& target) const;
    [[nodiscard]] bool meet(const Eigen::AlignedBox3d& box) const;

  private:
    std::vector<int> objects_;
    std::vector<Eigen::AlignedBox3d> boxes_;
};

/// The parts of scene and map that a search result depends on.
struct SearchFootprint {
    struct Place {
        Eigen::Vector3d position;
        bool cast_rays = false;  // whether rays were cast from here; else only the camera's fit was
                                 // tested
    };
    std::vector<Place> places;
    Eigen::AlignedBox3d target;  // see reachedBox()
    // centre of the region from which random cells were drawn
    Eigen::Vector3d sampled_around = Eigen::Vector3d::Zero();
    // radius of that region; negative: nothing was drawn
    double sampled_within_m = -1.0;
};

/// Differences between the maps of two scenes that can affect a search.
class MapChange {
  public:
    /// The regions, unless null, restrict the cells to sample from. Keeps references.
    MapChange(const FreeSpace& before, const AllowedRegion* region_before, const FreeSpace& now,
              const AllowedRegion* region_now);

    /// Whether the cell at a position changed its state or its room number.
    [[nodiscard]] bool at(const Eigen::Vector3d& place) const;
    /// Whether the cells to sample from differ within a distance of a point.
    [[nodiscard]] bool within(const Eigen::Vector3d& center, double distance_m) const;

  private:
    const FreeSpace& before_;
    const FreeSpace& now_;
    std::vector<Eigen::Vector3f> cells_;  // cells in only one of the maps
};

/// Whether a search may have a different result now. Conservative: never false if it would.
[[nodiscard]] bool isTouched(const SearchFootprint& footprint, const MovedObjects& moved,
                             const MapChange& map, double camera_radius_m);

}  // namespace dollytrack::planning
