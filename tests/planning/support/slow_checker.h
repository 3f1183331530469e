#pragma once

#include "engine/plan/plan.h"
#include "engine/scene/scene.h"

#include <memory>

namespace dollytrack::planning::test_support {

/// Measures trajectories against a scene's triangles, slowly and without any code of the planner:
/// with CGAL's distances in doubles, from the definition of the curves, every 2 mm and at every
/// frame.
class SlowChecker {
  public:
    explicit SlowChecker(const Scene& scene);
    ~SlowChecker();

    struct Found {
        double clearance_m = 0.0;  // the smallest found
        Eigen::Vector3d position = Eigen::Vector3d::Zero();
        int touching = 0;  // positions where the sphere overlaps a surface by more than rounding
        long places = 0;   // positions checked
    };
    [[nodiscard]] Found check(const Plan& plan, double radius_m, bool shaken) const;

    /// Distance to the nearest triangle, m.
    [[nodiscard]] double distance(const Eigen::Vector3d& position) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::planning::test_support
