#pragma once

#include "app/cli/scene_arguments.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/baselines/judge.h"
#include "planning/baselines/planner.h"
#include "planning/pipeline/pipeline.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::cli {

/// A parameter and the values it takes in turn.
struct SweptParameter {
    std::string name;
    std::string unit;
    std::vector<std::string> values;  // as `--set` reads them
};

/// From "name=from:to:step", ends included, or "name=a,b,c". Error: Usage, also for a value that
/// the parameter cannot take.
Result<SweptParameter> parseSweptParameter(const std::string& text);

/// The number that a text is, whole and finite; else nothing.
std::optional<double> finiteNumber(const std::string& text);

/// What came of one planner at one combination of values.
struct SweepPoint {
    std::vector<std::string> values;  // one for each parameter
    std::string planner;
    planning::JudgedRow metrics;
    std::vector<StageTime> stages;  // of Dollytrack's own pipeline; empty for others
    std::string gap;                // why there are no metrics; empty where there are
};

/// Plans the same scene again and again, keeping what a change does not concern: the scene, the
/// map, and the pipeline with its stages.
class Sweeper {
  public:
    explicit Sweeper(SceneArguments arguments) : arguments_(std::move(arguments)) {}

    /// A point of each planner with "name=value" set; where nothing can be mapped or planned with
    /// these values, with the reason. All have the same budget of frames. Errors: Cancelled, and
    /// what openScene() gives.
    Result<std::vector<SweepPoint>> at(const std::vector<std::string>& assignments,
                                       const std::vector<const planning::Planner*>& planners,
                                       const JobContext& job);

  private:
    Status open(const std::vector<std::string>& assignments, const JobContext& job);
    Status map(const planning::PlanParams& params, const JobContext& job);
    Result<planning::Flight> fly(const planning::Planner& planner,
                                 const planning::PlanParams& params, std::vector<StageTime>& stages,
                                 const JobContext& job);

    SceneArguments arguments_;
    std::optional<OpenedScene> opened_;
    std::vector<std::string> opened_with_;  // assignments that concern the import
    std::unique_ptr<planning::Pipeline> pipeline_;
    std::shared_ptr<const Plan> plan_;  // at the values at hand; null before it is made
    std::optional<planning::RivalScene> mapped_;
    CameraParams mapped_camera_;
    planning::FreeSpaceParams mapped_space_;
};

}  // namespace dollytrack::cli
