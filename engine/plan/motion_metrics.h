#pragma once

#include "engine/camera/trajectory.h"

#include <string>

namespace dollytrack {

/// How a measured quantity is distributed over the frames.
struct SampleStatistics {
    double median = 0.0;
    double p95 = 0.0;  // 95 % are no larger
    double max = 0.0;
};

/// How the camera moves, from the poses alone: differences from frame to frame, of the first order
/// for speed and turning rate, of the second for accelerations, of the third for jerk. Nothing is
/// measured across a change of path, or where frames were left out. At long frame intervals these
/// are means over them.
struct MotionMetrics {
    SampleStatistics speed_mps;
    SampleStatistics turn_dps;
    SampleStatistics acceleration_mps2;
    SampleStatistics turn_acceleration_dps2;
    SampleStatistics jerk_mps3;
};

[[nodiscard]] MotionMetrics measureMotion(const Trajectory& trajectory);

/// The one list of their published names: visit("speed_median_mps", value).
template <class Metrics, class Visitor>
void visitMotionMetrics(Metrics& m, Visitor&& visit) {
    const auto spread = [&](const std::string& name, const std::string& unit, auto& of) {
        visit(name + "_median_" + unit, of.median);
        visit(name + "_p95_" + unit, of.p95);
        visit(name + "_max_" + unit, of.max);
    };
    spread("speed", "mps", m.speed_mps);
    spread("turn", "dps", m.turn_dps);
    spread("acceleration", "mps2", m.acceleration_mps2);
    spread("turn_acceleration", "dps2", m.turn_acceleration_dps2);
    spread("jerk", "mps3", m.jerk_mps3);
}

}  // namespace dollytrack
