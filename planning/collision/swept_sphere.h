#pragma once

#include "engine/plan/viewpoint.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;
class RoomPlan;

/// Result of moving the camera sphere along a curve.
struct Sweep {
    bool free = false;
    double min_clearance_m = 0.0;  // centre to surface, the least met at the proof's points; in
                                   // between it may be a few millimetres less, but never below
                                   // the radius
    Eigen::Vector3d collision = Eigen::Vector3d::Zero();  // the centre where it stops
    int object_id = 0;                // what it meets; 0: no surface, see reason
    Verdict reason = Verdict::Legal;  // InObstacle, OutsideRoom, NoGo or HeightBand when not free
};

/// Proves moves of the camera sphere free, or finds where they collide. Conservative advancement:
/// from a point whose surface distance is d, all within d - radius is free, so the proof steps
/// from ball to ball and cannot miss a thin thing. No-go boxes count as things; a height band is
/// proven on its own. The body below a camera that drives is proven with the sphere, step by step.
/// Keeps references. Const, many threads.
class SweptSphere {
  public:
    /// Without a region everything is allowed that surfaces allow. With a plan of rooms no move
    /// leaves the room it begins in.
    SweptSphere(const RayCaster& rays, const FreeSpace& free_space, double radius_m,
                const AllowedRegion* region = nullptr, const RoomPlan* rooms = nullptr);

    /// Places keep this much more than the radius, so that proofs end in few steps.
    static constexpr double kMargin = 0.01;

    /// Whether the camera may stand here: room for the sphere and the margin, in free space.
    [[nodiscard]] bool fits(const Eigen::Vector3d& position) const;

    /// Why it may not, or Legal: InObstacle with the object, OutsideRoom, NoGo or HeightBand.
    [[nodiscard]] Verdict verdict(const Eigen::Vector3d& position, int& object_id) const;

    /// Distance to the nearest surface, exact below `limit`, else at least `limit`.
    [[nodiscard]] double clearance(const Eigen::Vector3d& position, double limit) const;

    [[nodiscard]] Sweep segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    /// Quadratic Bezier curve.
    [[nodiscard]] Sweep bezier(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                               const Eigen::Vector3d& end) const;

    [[nodiscard]] double radius() const { return radius_m_; }

    /// The place, moved up or down into the height band.
    [[nodiscard]] Eigen::Vector3d inBand(const Eigen::Vector3d& place) const;

    /// The place, moved up or down where the camera's height is exact.
    [[nodiscard]] Eigen::Vector3d onHeight(const Eigen::Vector3d& place) const;

    /// Cells of a room to sample from, those only that the region allows.
    [[nodiscard]] const std::vector<Eigen::Vector3f>& cells(int component) const;

    /// Null without one.
    [[nodiscard]] const AllowedRegion* region() const { return region_; }

  private:
    const RayCaster* rays_;
    const FreeSpace* free_space_;
    double radius_m_;
    const AllowedRegion* region_;  // null where it would restrict nothing
    const RoomPlan* rooms_;        // null where moves may go on through doorways
};

}  // namespace dollytrack::planning
