#pragma once

#include "app/cli/scene_arguments.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/baselines/planner.h"
#include "planning/baselines/planner_metrics.h"
#include "planning/pipeline/pipeline.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::cli {

/// A parameter and its sweep values.
struct SweptParameter {
    std::string name;
    std::string unit;
    std::vector<std::string> values;  // in the form of `--set`
};

/// Parses "name=from:to:step" (ends included) or "name=a,b,c". Error: Usage, also for values that
/// the parameter does not accept.
Result<SweptParameter> parseSweptParameter(const std::string& text);

/// Parses a finite number; nullopt if the text is anything else.
std::optional<double> finiteNumber(const std::string& text);

/// Result of one planner for one combination of values.
struct SweepPoint {
    std::vector<std::string> values;  // one value per parameter
    std::string planner;
    planning::MetricsRow metrics;
    std::vector<StageTime> stages;  // stage times of our planner; empty for others
    std::string gap;                // why there are no metrics; empty if there are
};

/// Plans one scene repeatedly and reuses what a parameter change does not affect: the scene, the
/// map, and stages of the pipeline.
class Sweeper {
  public:
    explicit Sweeper(SceneArguments arguments) : arguments_(std::move(arguments)) {}

    /// Plans with each planner with these "name=value" assignments, all with the same frame budget.
    /// If mapping or planning fails, the point has the reason in `gap`. Errors: Cancelled; errors
    /// of openScene().
    Result<std::vector<SweepPoint>> at(const std::vector<std::string>& assignments,
                                       const std::vector<const planning::Planner*>& planners,
                                       const JobContext& job);

  private:
    Status open(const std::vector<std::string>& assignments, const JobContext& job);
    Status map(const planning::PlanParams& params, const JobContext& job);
    Result<planning::PlannedMotion> planMotion(const planning::Planner& planner,
                                               const planning::PlanParams& params,
                                               std::vector<StageTime>& stages,
                                               const JobContext& job);

    SceneArguments arguments_;
    std::optional<OpenedScene> opened_;
    std::vector<std::string> opened_with_;  // assignments that affect the import
    std::unique_ptr<planning::Pipeline> pipeline_;
    std::shared_ptr<const Plan> plan_;  // plan for the current values; null until needed
    std::optional<planning::MappedScene> mapped_;
    CameraParams mapped_camera_;
    planning::FreeSpaceParams mapped_space_;
};

}  // namespace dollytrack::cli
