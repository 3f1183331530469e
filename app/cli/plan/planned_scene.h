#pragma once

#include "app/cli/scene_arguments.h"
#include "engine/plan/plan.h"
#include "planning/pipeline/pipeline.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>

namespace dollytrack::cli {

/// A scene with its trajectory, newly planned or from a project.
struct PlannedScene {
    std::shared_ptr<const Scene> scene;
    planning::PlanParams params;
    std::shared_ptr<const Plan> plan;  // null if stored in a project, and for baselines
    Trajectory trajectory;
    std::vector<Eigen::AlignedBox3d> rooms;  // room bounds, by component of free space
    nlohmann::json metrics;                  // see metricsJson()
    nlohmann::json result;                   // the result to store in a project file
    std::string nothing_free;  // why the user's settings leave no free space; or empty
};

/// Plans on a pipeline that the caller may use further. `plan` is set. Warns about unvisited
/// anchors and pins, low frame rates and separate motions. Errors: those of Pipeline::run(); Usage
/// if the camera cannot be at the --start or --end of the command line.
Result<PlannedScene> planScene(const OpenedScene& opened, planning::Pipeline& pipeline,
                               const JobContext& job);

/// Why the trajectory has no frames; empty if it has some.
std::string whyEmpty(const PlannedScene& planned);

/// Returns the project's stored plan if it is still valid and has frames; otherwise plans.
Result<PlannedScene> planOrReuse(const OpenedScene& opened, const JobContext& job);

}  // namespace dollytrack::cli
