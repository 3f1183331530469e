#pragma once

#include "app/cli/scene_arguments.h"
#include "engine/plan/plan.h"
#include "planning/pipeline/pipeline.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>

namespace dollytrack::cli {

/// A scene with its trajectory, planned now or stored in a project.
struct PlannedScene {
    std::shared_ptr<const Scene> scene;
    planning::PlanParams params;
    std::shared_ptr<const Plan> plan;  // null when the result came from a project
    Trajectory trajectory;
    std::vector<Eigen::AlignedBox3d> rooms;  // by component of free space
    nlohmann::json metrics;                  // see metricsJson()
    nlohmann::json result;                   // for a project file
    std::string nothing_free;  // why what a person forbids leaves no place; empty: there is one
};

/// Plans, on a pipeline that the caller may ask further. `plan` is set. Errors as Pipeline::run(),
/// and Usage where the camera cannot be where the command line wants it to begin or to end.
Result<PlannedScene> planScene(const OpenedScene& opened, planning::Pipeline& pipeline,
                               const JobContext& job);

/// Why the trajectory has no frames; empty when it has some.
std::string whyEmpty(const PlannedScene& planned);

/// The stored plan of a project when it still holds, else plans.
Result<PlannedScene> planOrReuse(const OpenedScene& opened, const JobContext& job);

}  // namespace dollytrack::cli
