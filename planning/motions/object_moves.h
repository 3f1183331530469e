#pragma once

#include "engine/jobs/job.h"
#include "planning/visibility/framing.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace dollytrack {
struct Object;
}

namespace dollytrack::planning {

struct MappedScene;

/// Distances tried where an ideal one is not free, as factors of it, the best first.
inline constexpr std::array<double, 8> kDistanceFactors = {1.0,  0.92, 1.08, 0.84,
                                                           1.16, 0.76, 0.68, 0.6};

/// Largest distance between the positions of a camera move, m.
inline constexpr double kMoveSpacing = 0.05;

/// Positions of an orbit, and the share of the wanted arc that they cover.
struct Orbit {
    std::vector<Eigen::Vector3d> positions;
    double share = 0.0;
};

/// Computes where the camera would be during a move around an object or a point if no obstacle were
/// in the way. The scene must outlive this object.
class ObjectMoves {
  public:
    ObjectMoves(const MappedScene& scene, const Object& object);
    /// Moves around a point, from a usual distance of `reach_m`. Furniture may hide the point, but
    /// walls and other parts of the building may not.
    ObjectMoves(const MappedScene& scene, const Eigen::Vector3d& center, double reach_m);

    /// The point to look at.
    [[nodiscard]] Eigen::Vector3d center() const { return subject_.center; }

    /// Distance in front of the object at which it takes this share of the image, m. A point counts
    /// as an object that takes half of the image at the usual distance.
    [[nodiscard]] double distanceFor(double fill) const;

    /// Positions on an arc around the object, whose middle is in front of it: the longest part in
    /// which the camera fits and sees the object. Where it does not fit at `radius_m`, the radius
    /// is a little smaller or larger. Empty if the part is shorter than 20 degrees, or if
    /// cancelled.
    [[nodiscard]] Orbit orbit(double radius_m, double z, double arc_rad,
                              const JobContext& job) const;

    /// Makes the radius of an orbit change smoothly with the angle. It is as near to `radius_m` as
    /// obstacles allow; the ends stay where they are.
    void smoothRadius(Orbit& orbit, double radius_m, const JobContext& job) const;

    /// Both ends of the straight move beside the object between two horizontal distances from its
    /// centre and two heights z, in the direction nearest to its front where the move is free and
    /// sees it; empty if there is none.
    [[nodiscard]] std::vector<Eigen::Vector3d> straight(double from_m, double from_z, double to_m,
                                                        double to_z) const;

  private:
    [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& out, double distance_m, double z) const;
    [[nodiscard]] std::optional<Eigen::Vector3d> placeAt(const Eigen::Vector3d& out,
                                                         double radius_m, double z) const;
    [[nodiscard]] bool isSeen(const Eigen::Vector3d& place) const;

    const MappedScene& scene_;
    Subject subject_;
    Eigen::Vector3d front_ = Eigen::Vector3d::UnitX();
    int object_id_ = 0;     // 0: around a point
    double reach_m_ = 0.0;  // of a point
};

}  // namespace dollytrack::planning
