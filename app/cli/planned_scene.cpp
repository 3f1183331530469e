#include "app/cli/planned_scene.h"

#include "engine/core/log.h"
#include "engine/plan/plan_json.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::cli {

namespace {

/// Of what was asked for and is not there, or is not visited. Where all kinds are asked for, it is
/// no news that a scene lacks some.
void warnOfAnchors(const Plan& plan) {
    const auto& anchors = plan.anchors;
    const bool none = !anchors.empty() && std::all_of(anchors.begin(), anchors.end(),
                                                      [](const auto& a) { return a.found == 0; });
    if (none) {
        log::warn("planning", anchors.size() == 1
                                  ? "the scene has no " + anchors[0].kind + " to visit as anchors"
                                  : std::string("the scene has no doorways, openings or corridors "
                                                "to visit as anchors"));
    }
    for (const AnchorTally& one : anchors) {
        if (one.visited >= one.found) continue;
        log::warn("planning",
                  fmt::format("{} of {} {} are not visited: the camera finds no place there, or no "
                              "way leads to it",
                              one.found - one.visited, one.found, one.kind));
    }
}

}  // namespace

Result<PlannedScene> planScene(const OpenedScene& opened, planning::Pipeline& pipeline,
                               const JobContext& job) {
    const auto plan = pipeline.run(opened.params, opened.plan_edits, job);
    if (!plan) return tl::unexpected<Error>(plan.error());
    for (const RefusedPin& pin : (*plan)->refused_pins) {
        log::warn("planning", "the pinned point \"" + pin.name + "\" is not used: " + pin.reason);
    }
    warnOfAnchors(**plan);
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
