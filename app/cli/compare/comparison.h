#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/baselines/planner.h"
#include "planning/baselines/planner_metrics.h"

#include <string>
#include <vector>

namespace dollytrack::cli {

/// An existing trajectory, evaluated beside the planners.
struct ExternalTrajectory {
    std::string name;
    planning::PlannedMotion motion;
};

/// Metrics of one planner in one scene: medians over the seeds.
struct ComparedRow {
    std::string planner;
    planning::MetricsRow values;  // in the order of plannerMetricInfos()
};

struct ComparedScene {
    std::string scene;  // name in tables; set by the caller
    double map_ms = 0.0;
    std::vector<ComparedRow> rows;
    int failures = 0;  // trajectories that could not be planned; each is logged
};

struct ComparisonOrder {
    std::vector<const planning::Planner*> planners;
    int seeds = 1;  // number of seeds, starting at the parameters' seed
    bool bound = false;
};

/// Plans with every planner on one map of the scene and evaluates all trajectories in the same way.
/// With `bound`, the last row is an upper bound on the capture rates: a dense viewpoint search plus
/// all captures of the trajectories. A planner that fails is skipped with a warning. Errors: Usage
/// if the seeds exceed the largest int; errors of the map; Cancelled.
Result<ComparedScene> compareIn(std::shared_ptr<const Scene> scene, const PlanEdits& edits,
                                const planning::PlanParams& params, const ComparisonOrder& order,
                                const std::vector<ExternalTrajectory>& given,
                                const JobContext& job);

/// Means by planner, over the scenes in which the planner has a row.
ComparedScene meanOver(const std::vector<ComparedScene>& scenes);

/// A text table with one line per planner and one column per metric; columns without values are
/// omitted.
std::string comparisonTable(const ComparedScene& scene);

/// Display names of scenes: their file stems, with the parent folder if several are equal.
std::vector<std::string> sceneNames(const std::vector<std::string>& paths);

/// Quotes a text for a CSV field if it contains commas, quotes or line breaks.
std::string csvField(const std::string& text);

/// CSV with all metrics, one line per scene and planner; empty if a metric does not apply.
std::string comparisonCsv(const std::vector<ComparedScene>& scenes);

}  // namespace dollytrack::cli
