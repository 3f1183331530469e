#include "app/cli/planned_scene.h"

#include "engine/core/log.h"
#include "engine/plan/plan_json.h"

namespace dollytrack::cli {

Result<PlannedScene> planScene(const OpenedScene& opened, planning::Pipeline& pipeline,
                               const JobContext& job) {
    const auto plan = pipeline.run(opened.params, opened.plan_edits, job);
    if (!plan) return tl::unexpected<Error>(plan.error());
    for (const RefusedPin& pin : (*plan)->refused_pins) {
        log::warn("planning", "the pinned point \"" + pin.name + "\" is not used: " + pin.reason);
    }
    PlannedScene planned;
    planned.scene = opened.scene;
    planned.params = opened.params;
    planned.plan = *plan;
    planned.trajectory = (*plan)->trajectory;
    planned.rooms = (*plan)->rooms;
    planned.metrics = metricsJson(*opened.scene, **plan);
    planned.result = resultJson(*opened.scene, **plan);
    return planned;
}

Result<PlannedScene> planOrReuse(const OpenedScene& opened, const JobContext& job) {
    if (opened.stored_result.is_null()) {
        planning::Pipeline pipeline(opened.scene);
        return planScene(opened, pipeline, job);
    }
    PlannedScene planned;
    planned.scene = opened.scene;
    planned.params = opened.params;
    planned.result = opened.stored_result;
    planned.metrics = opened.stored_result.value("metrics", nlohmann::json::object());
    Result<Trajectory> trajectory =
        trajectoryFromJson(opened.stored_result.value("trajectory", nlohmann::json::object()));
    if (!trajectory) return tl::unexpected<Error>(std::move(trajectory.error()));
    planned.trajectory = std::move(*trajectory);
    Result<std::vector<Eigen::AlignedBox3d>> rooms = roomsFromJson(opened.stored_result);
    if (!rooms) return tl::unexpected<Error>(std::move(rooms.error()));
    planned.rooms = std::move(*rooms);
    return planned;
}

}  // namespace dollytrack::cli
