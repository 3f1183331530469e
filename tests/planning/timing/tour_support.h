#pragma once

#include "planning/plan_params.h"
#include "planning/timing/time_trajectory.h"

#include <optional>
#include <vector>

namespace dollytrack::planning::test_support {

/// Paths with key frames, each looking at a target of its own, for tests of timing.
struct Tour {
    std::vector<PositionPoint> points;
    std::vector<ObservationPoint> targets;
    std::vector<SmoothPath> paths;
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    bool begun = false;  // the path has a position

    void startPath() {
        paths.emplace_back();
        begun = false;
    }

    /// Moves straight to a position and stops there.
    void stop(const Eigen::Vector3d& place) {
        if (begun) paths.back().append(last, 0.5 * (last + place), place, false);
        last = place;
        begun = true;
    }

    void key(const Eigen::Vector3d& place, const Eigen::Vector3d& target) {
        stop(place);
        addKey(paths.back().length_m, place, target);
    }

    /// Moves towards a corner and around it to `end`. The curve begins as far before the corner as
    /// it ends after it, at most `set_back`; a key frame is in its middle.
    void curve(const Eigen::Vector3d& corner, const Eigen::Vector3d& end, double set_back,
               std::optional<Eigen::Vector3d> target) {
        SmoothPath& path = paths.back();
        const double least = std::min((corner - last).norm(), (end - corner).norm());
        set_back = std::min(set_back, 0.5 * least);
        const Eigen::Vector3d a = corner + set_back * (last - corner).normalized();
        const Eigen::Vector3d b = corner + set_back * (end - corner).normalized();
        stop(a);
        const double before = path.length_m;
        path.append(a, corner, b, true);
        if (target) {
            addKey(0.5 * (before + path.length_m), 0.25 * a + 0.5 * corner + 0.25 * b, *target);
        }
        last = b;
        stop(end);
    }

    [[nodiscard]] Result<Trajectory> timed(const TimingParams& params) const {
        return timeTrajectory(paths, points, targets, params);
    }

  private:
    void addKey(double arc_m, const Eigen::Vector3d& place, const Eigen::Vector3d& target) {
        ObservationPoint observation;
        observation.position = target;
        PositionPoint point;
        point.observation_point = static_cast<int>(targets.size());
        point.pose = lookAt(place, target);
        targets.push_back(observation);
        points.push_back(point);
        paths.back().keys.push_back({arc_m, static_cast<int>(points.size()) - 1, place});
    }
};

}  // namespace dollytrack::planning::test_support
