#pragma once

#include "engine/document/edits.h"
#include "engine/plan/viewpoint.h"
#include "planning/collision/floor_levels.h"
#include "planning/collision/no_go_index.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace dollytrack {
class RayCaster;
struct Scene;
}  // namespace dollytrack

namespace dollytrack::planning {

class FloorHeights;
class FreeSpace;
struct BodyParams;
struct FreeSpaceParams;

/// The user's restrictions of the camera position, in addition to the surfaces of the scene: the
/// camera sphere stays outside all no-go boxes, and its centre stays in a band of heights above the
/// floor. A camera with an exact height stays on floor levels instead, together with its body (see
/// FloorLevels). Immutable; safe to call from many threads.
class AllowedRegion {
  public:
    AllowedRegion(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                  const std::vector<NoGoBox>& no_go, const FreeSpaceParams& params,
                  const BodyParams& body, double camera_radius_m);
    ~AllowedRegion();
    AllowedRegion(AllowedRegion&&) noexcept;
    AllowedRegion& operator=(AllowedRegion&&) noexcept;

    /// Whether there is any no-go box, height band or exact height.
    [[nodiscard]] bool restricts() const { return !no_go_.empty() || floors_ != nullptr; }

    /// Whether heights above the floor are restricted.
    [[nodiscard]] bool hasBand() const { return floors_ != nullptr; }

    /// Whether the camera has an exact height above the floor.
    [[nodiscard]] bool hasLevels() const { return levels_ != nullptr; }

    /// The floor levels. Requires hasLevels().
    [[nodiscard]] const FloorLevels& levels() const { return *levels_; }

    /// Free distance around the body of a camera with an exact height; infinite without one.
    [[nodiscard]] BodyClearance bodyClearance(const Eigen::Vector3d& center) const {
        return levels_ ? levels_->clearance(center) : BodyClearance{};
    }

    /// Verdict on a camera sphere of this radius: Legal, NoGo (touches a box), HeightBand (outside
    /// the band or off all levels), InObstacle (the body collides), or OutsideRoom (the body cannot
    /// drive there).
    [[nodiscard]] Verdict verdict(const Eigen::Vector3d& center, double radius_m) const;

    /// Distance from a point to the nearest no-go box, m; 0 inside a box, infinity without boxes.
    [[nodiscard]] double noGoDistance(const Eigen::Vector3d& point) const;

    /// The nearest no-go box that the sphere overlaps, or null. The pointer is valid as long as
    /// this object.
    [[nodiscard]] const NoGoBox* boxAt(const Eigen::Vector3d& center, double radius_m) const;

    /// Whether a quadratic Bezier curve stays in the height band. The proof subdivides the curve
    /// until the bounding box of each piece lies in the band. A piece shorter than 1 mm that cannot
    /// be proven counts as outside, and `where` is set to its start. With floor levels, all three
    /// points must be at the height of one level.
    [[nodiscard]] bool bandHolds(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                                 const Eigen::Vector3d& end, Eigen::Vector3d& where) const;

    /// The position moved vertically into the height band, or to the camera's height above a level.
    /// Returns it unchanged without a height restriction.
    [[nodiscard]] Eigen::Vector3d inBand(const Eigen::Vector3d& place) const;

    /// Height above the floor below the position, m. Requires hasBand().
    [[nodiscard]] double heightOf(const Eigen::Vector3d& place) const;

    /// Centres of the cells of a component of free space (see FreeSpace::cells) that are allowed.
    /// Requires restricts().
    [[nodiscard]] const std::vector<Eigen::Vector3f>& cells(int component) const {
        return (levels_ ? levels_->cells() : cells_)[component];
    }

  private:
    [[nodiscard]] bool pieceHolds(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                                  const Eigen::Vector3d& end, Eigen::Vector3d& where) const;

    std::vector<NoGoBox> no_go_;
    double min_height_m_;
    double max_height_m_;
    std::unique_ptr<const FloorHeights> floors_;       // null without a height restriction
    std::unique_ptr<const FloorLevels> levels_;        // null unless the camera's height is exact
    std::vector<std::vector<Eigen::Vector3f>> cells_;  // by component; empty with levels
    NoGoIndex index_;                                  // over no_go_
};

}  // namespace dollytrack::planning
