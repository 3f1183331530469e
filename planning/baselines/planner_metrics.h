#pragma once

#include "engine/plan/capture.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/baselines/planned_motion.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::planning {

/// Measurements of a planner's result. All are computed by the same code, from poses and scene
/// alone. Rates are 0..1. Values that do not apply are empty, for example speeds of frames without
/// motion between them.
struct PlannerMetrics {
    CaptureMetrics captures;
    std::vector<ObjectCapture> objects;  // one per target
    int frames = 0;
    double repeat_rate = 0.0;              // see TrajectoryMetrics
    double object_pixels = 0.0;            // see TrajectoryMetrics
    std::optional<double> trackable_rate;  // see TrajectoryMetrics
    double frame_collision_rate = 0.0;     // share of the frames with a surface inside the camera
                                           // sphere
    double outside_rate = 0.0;             // share of the frames outside free space
    double min_clearance_m = 0.0;          // camera centre to surface, along all motion, to 1 cm
    std::optional<double> move_collision_rate;    // share of the moves between frames with a
                                                  // surface inside the camera sphere
    std::optional<double> corner_collision_rate;  // see PlannedMotion
    std::optional<double> path_length_m;
    std::optional<double> speed_median_mps, speed_max_mps;  // between frames
    std::optional<double> turn_median_dps, turn_max_dps;    // between frames
    std::optional<double> jerk_median_mps3, jerk_max_mps3;  // from third differences of positions
    std::optional<double> plan_ms;  // measured by the planner; empty for poses from a file
};

/// Measures a planner's result. Error: Cancelled.
Result<PlannerMetrics> measurePlannedMotion(const MappedScene& scene, const PlannedMotion& motion,
                                            const JobContext& job);

enum class Better { Higher, Lower, Neither };

/// Description of one value of a PlannerMetrics, for tables, files and plots.
struct MetricInfo {
    std::string_view name;   // key in files
    std::string_view title;  // column header
    std::string_view unit;   // "%": the value is a rate, 0..1
    Better better = Better::Neither;
};

/// A value as text without its unit, rates in percent, with the digits that matter; "-" if empty.
std::string metricNumber(const MetricInfo& info, const std::optional<double>& value);

/// Visits all values. Calls visit(info, value); the value is a number or an optional number.
template <class Metrics, class Visitor>
void visitPlannerMetrics(Metrics& metrics, Visitor&& visit) {
    using enum Better;
    visit(MetricInfo{"objects", "objects", "", Neither}, metrics.captures.objects);
    visit(MetricInfo{"capture_rate", "captured", "%", Higher}, metrics.captures.capture_rate);
    visit(MetricInfo{"well_captured_rate", "well", "%", Higher},
          metrics.captures.well_captured_rate);
    visit(MetricInfo{"small_capture_rate", "small", "%", Higher},
          metrics.captures.small_capture_rate);
    visit(MetricInfo{"area_share_box", "box", "%", Higher}, metrics.captures.area_share_box);
    visit(MetricInfo{"area_share_mask", "mask", "%", Higher}, metrics.captures.area_share_mask);
    visit(MetricInfo{"object_pixels", "on objects", "%", Higher}, metrics.object_pixels);
    visit(MetricInfo{"repeat_rate", "repeats", "%", Lower}, metrics.repeat_rate);
    visit(MetricInfo{"trackable_rate", "trackable", "%", Higher}, metrics.trackable_rate);
    visit(MetricInfo{"frame_collision_rate", "hit frames", "%", Lower},
          metrics.frame_collision_rate);
    visit(MetricInfo{"move_collision_rate", "hit moves", "%", Lower}, metrics.move_collision_rate);
    visit(MetricInfo{"corner_collision_rate", "hit corners", "%", Lower},
          metrics.corner_collision_rate);
    visit(MetricInfo{"outside_rate", "outside", "%", Lower}, metrics.outside_rate);
    visit(MetricInfo{"min_clearance_m", "clearance", "m", Higher}, metrics.min_clearance_m);
    visit(MetricInfo{"frames", "frames", "", Neither}, metrics.frames);
    visit(MetricInfo{"path_length_m", "path", "m", Lower}, metrics.path_length_m);
    visit(MetricInfo{"speed_median_mps", "speed", "m/s", Neither}, metrics.speed_median_mps);
    visit(MetricInfo{"speed_max_mps", "max", "m/s", Neither}, metrics.speed_max_mps);
    visit(MetricInfo{"turn_median_dps", "turn", "deg/s", Neither}, metrics.turn_median_dps);
    visit(MetricInfo{"turn_max_dps", "max", "deg/s", Lower}, metrics.turn_max_dps);
    visit(MetricInfo{"jerk_median_mps3", "jerk", "m/s3", Neither}, metrics.jerk_median_mps3);
    visit(MetricInfo{"jerk_max_mps3", "max", "m/s3", Lower}, metrics.jerk_max_mps3);
    visit(MetricInfo{"plan_ms", "plan", "ms", Lower}, metrics.plan_ms);
}

/// A PlannerMetrics as a row of numbers, in the order of plannerMetricInfos().
using MetricsRow = std::vector<std::optional<double>>;

const std::vector<MetricInfo>& plannerMetricInfos();
MetricsRow toRow(const PlannerMetrics& measured);

/// Column-wise median and mean, over the rows with a value in the column; empty if there is none.
MetricsRow medianOf(const std::vector<MetricsRow>& rows);
MetricsRow meanOf(const std::vector<MetricsRow>& rows);

}  // namespace dollytrack::planning
