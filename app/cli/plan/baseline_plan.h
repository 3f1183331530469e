#pragma once

#include "app/cli/plan/planned_scene.h"
#include "app/cli/scene_arguments.h"

#include <nlohmann/json.hpp>

#include <string>

namespace CLI {
class App;
}

namespace dollytrack::cli {

/// Adds --planner, for commands that plan one trajectory.
void addPlannerArgument(CLI::App& command, std::string& planner);

/// Whether the name is a baseline planner rather than our own. Error: Usage for an unknown name,
/// with the closest one.
Result<bool> namesBaseline(const std::string& planner);

/// Plans with a baseline planner, with the seed of the parameters. The metrics are those of
/// `compare` (null if one does not apply) and the planner's name. `result` stays null, because
/// projects only store our own plans. Errors: those of the planner.
Result<PlannedScene> planWithBaseline(const std::string& planner, const OpenedScene& opened,
                                      const JobContext& job);

/// Evaluates any trajectory in this scene: the metrics of `compare`, and as "ledger" one object per
/// target with its name and id, whether it is captured and well captured, and the frame that shows
/// it best with its visible fraction and box share (frame -1: never seen). Errors: Usage for
/// contradictory parameters, BadInput if the scene cannot be mapped, Cancelled.
Result<nlohmann::json> evaluateTrajectory(const OpenedScene& opened, const Trajectory& trajectory,
                                          const JobContext& job);

/// All metric names of `plan --planner`, with placeholder values, to check names before planning.
/// The planner must be known.
nlohmann::json metricsOf(const std::string& planner);

/// A baseline's metrics as text, one per line.
std::string plannerMetricsTable(const nlohmann::json& metrics);

}  // namespace dollytrack::cli
