#pragma once

#include "app/cli/scene_arguments.h"
#include "engine/plan/plan.h"
#include "planning/pipeline.h"

#include <nlohmann/json.hpp>

#include <memory>

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
};

/// Plans, on a pipeline that the caller may ask further. `plan` is set. Errors as Pipeline::run().
Result<PlannedScene> planScene(const OpenedScene& opened, planning::Pipeline& pipeline,
                               const JobContext& job);

/// The stored plan of a project when it still holds, else plans.
Result<PlannedScene> planOrReuse(const OpenedScene& opened, const JobContext& job);

}  // namespace dollytrack::cli
