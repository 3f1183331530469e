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

/// Where a person lets the camera be, beside what the room's surfaces allow: outside all no-go
/// boxes with the whole sphere, and with its centre in a band of heights above the floor. A camera
/// of exact height drives on levels of the floor instead, with its body (see FloorLevels). Const.
class AllowedRegion {
  public:
    AllowedRegion(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                  const std::vector<NoGoBox>& no_go, const FreeSpaceParams& params,
                  const BodyParams& body, double camera_radius_m);
    ~AllowedRegion();
    AllowedRegion(AllowedRegion&&) noexcept;
    AllowedRegion& operator=(AllowedRegion&&) noexcept;

    /// False: everything is allowed.
    [[nodiscard]] bool restricts() const { return !no_go_.empty() || floors_ != nullptr; }

    /// Whether it keeps the camera in a band of heights.
    [[nodiscard]] bool hasBand() const { return floors_ != nullptr; }

    /// Whether the camera drives at an exact height.
    [[nodiscard]] bool hasLevels() const { return levels_ != nullptr; }

    /// Requires hasLevels().
    [[nodiscard]] const FloorLevels& levels() const { return *levels_; }

    /// Around the body of a camera that drives; endless for others.
    [[nodiscard]] BodyGap bodyGap(const Eigen::Vector3d& center) const {
        return levels_ ? levels_->gap(center) : BodyGap{};
    }

    /// Legal, NoGo, HeightBand, InObstacle for the body, or OutsideRoom where that cannot drive,
    /// for a sphere of this radius.
    [[nodiscard]] Verdict verdict(const Eigen::Vector3d& center, double radius_m) const;

    /// Distance from a point to the nearest no-go box; 0 inside one, infinite without any.
    [[nodiscard]] double noGoDistance(const Eigen::Vector3d& point) const;

    /// The box that a sphere enters, nearest first; null when it enters none.
    [[nodiscard]] const NoGoBox* boxAt(const Eigen::Vector3d& center, double radius_m) const;

    /// Whether a quadratic Bezier curve stays in the height band all along: the boxes around ever
    /// shorter pieces of it do. A piece of 1 mm that cannot be proven counts as outside; `where`
    /// is then its start.
    [[nodiscard]] bool bandHolds(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                                 const Eigen::Vector3d& end, Eigen::Vector3d& where) const;

    /// The place, moved up or down into the band, or onto a level.
    [[nodiscard]] Eigen::Vector3d inBand(const Eigen::Vector3d& place) const;

    /// Height above the floor, m. Only with a band.
    [[nodiscard]] double heightOf(const Eigen::Vector3d& place) const;

    /// Those of the room's cells (see FreeSpace::cells) that are allowed. Only where restricts().
    [[nodiscard]] const std::vector<Eigen::Vector3f>& cells(int component) const {
        return (levels_ ? levels_->cells() : cells_)[static_cast<std::size_t>(component)];
    }

  private:
    [[nodiscard]] bool pieceHolds(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                                  const Eigen::Vector3d& end, Eigen::Vector3d& where) const;

    std::vector<NoGoBox> no_go_;
    double min_height_m_;
    double max_height_m_;
    std::unique_ptr<const FloorHeights> floors_;  // null without a band
    std::unique_ptr<const FloorLevels> levels_;   // null where the camera's height is not exact
    std::vector<std::vector<Eigen::Vector3f>> cells_;  // empty with levels
    NoGoIndex index_;                                  // of no_go_
};

}  // namespace dollytrack::planning
