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
struct SweepResult {
    bool free = false;
    double min_clearance_m = 0.0;  // centre to surface, the least found at sampled points of the
                                   // proof; between them it may be a few millimetres less, but
                                   // never below the radius
    Eigen::Vector3d collision = Eigen::Vector3d::Zero();  // centre of the sphere where it collides
    int object_id = 0;                                    // object hit; 0: no surface, see reason
    Verdict reason = Verdict::Legal;  // if not free: InObstacle, OutsideRoom, NoGo or HeightBand
};

/// Proves moves of the camera sphere collision-free, or finds where they collide, by conservative
/// advancement: from a point with surface distance d, the sphere may move by d - radius, so no thin
/// object is missed. No-go boxes are obstacles; the height band is proven separately. At each step
/// the body of a camera with an exact height is tested as well. Keeps references to its arguments.
/// Immutable; safe to call from many threads.
class SweptSphere {
  public:
    /// Without `region`, only surfaces and free space restrict the camera. With `rooms`, no move
    /// may leave the room it starts in.
    SweptSphere(const RayCaster& rays, const FreeSpace& free_space, double radius_m,
                const AllowedRegion* region = nullptr, const RoomPlan* rooms = nullptr);

    /// Extra distance beyond the radius that a legal position keeps, m, so that proofs need few
    /// steps.
    static constexpr double kMargin = 0.01;

    /// Whether the camera may be here: in free space, in the region, with room for sphere and
    /// margin.
    [[nodiscard]] bool fits(const Eigen::Vector3d& position) const;

    /// Why fits() is false: the first of NoGo, InObstacle, OutsideRoom and HeightBand that applies;
    /// else Legal. With InObstacle `object_id` is the object in the way, or 0 if only the cell is
    /// occupied.
    [[nodiscard]] Verdict verdict(const Eigen::Vector3d& position, int& object_id) const;

    /// Distance to the nearest surface, m: exact below `limit`, otherwise a value of at least
    /// `limit`.
    [[nodiscard]] double clearance(const Eigen::Vector3d& position, double limit) const;

    [[nodiscard]] SweepResult segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    /// Tests a move along a quadratic Bezier curve.
    [[nodiscard]] SweepResult bezier(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                                     const Eigen::Vector3d& end) const;

    [[nodiscard]] double radius() const { return radius_m_; }

    /// The position moved vertically into the height band or onto a floor level, if there is one.
    [[nodiscard]] Eigen::Vector3d inBand(const Eigen::Vector3d& place) const;

    /// The position moved vertically onto a floor level if the camera's height is exact; else
    /// unchanged.
    [[nodiscard]] Eigen::Vector3d onHeight(const Eigen::Vector3d& place) const;

    /// Centres of a component's cells that the region allows, for sampling.
    [[nodiscard]] const std::vector<Eigen::Vector3f>& cells(int component) const;

    /// The region given to the constructor; null if there was none or it restricts nothing.
    [[nodiscard]] const AllowedRegion* region() const { return region_; }

  private:
    const RayCaster* rays_;
    const FreeSpace* free_space_;
    double radius_m_;
    const AllowedRegion* region_;  // null if it restricts nothing
    const RoomPlan* rooms_;        // null if moves may pass through doorways
};

}  // namespace dollytrack::planning
