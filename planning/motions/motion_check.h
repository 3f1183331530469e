#pragma once

#include "planning/collision/swept_sphere.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace dollytrack::planning {

struct MappedScene;

/// Tests given positions and straight moves: free of surfaces for the camera sphere, in free space
/// and in the allowed region. Unlike SweptSphere::fits() it asks for no margin, so that motion made
/// by others is kept wherever it is free. Immutable; safe to call from many threads.
class MotionCheck {
  public:
    explicit MotionCheck(const MappedScene& scene);

    [[nodiscard]] bool isFree(const Eigen::Vector3d& position) const;
    [[nodiscard]] bool isFree(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    /// The component of free space that a free position belongs to, by its cell or a neighbouring
    /// cell that the camera reaches; -1: none.
    [[nodiscard]] int componentOf(const Eigen::Vector3d& position) const;

  private:
    const MappedScene& scene_;
    // Radius reduced by SweptSphere's contact margin, so that touching a surface is allowed.
    SweptSphere touching_;
};

/// Why the camera cannot be at a position that is not free, as a phrase: "is in or too close to
/// 'wall'".
[[nodiscard]] std::string whyNotFree(const MappedScene& scene, const Eigen::Vector3d& position);

/// The position nearest to a given one at which the camera fits; empty if there is none.
[[nodiscard]] std::optional<Eigen::Vector3d> nearestFree(const MappedScene& scene,
                                                         const Eigen::Vector3d& position);

}  // namespace dollytrack::planning
