#pragma once

#include "app/cli/plan/planned_scene.h"
#include "app/cli/scene_arguments.h"

#include <nlohmann/json.hpp>

#include <string>

namespace CLI {
class App;
}

namespace dollytrack::cli {

/// --planner, for commands that make one trajectory.
void addPlannerArgument(CLI::App& command, std::string& planner);

/// Whether it is another planner than our own. Error: Usage, with the closest name.
Result<bool> namesRival(const std::string& planner);

/// The trajectory of a rival, with the seed of the parameters. Its metrics are what the judge of
/// `compare` measures (null where one does not apply) and the planner's name. There is no result
/// for a project: what projects keep are our own plans. Errors: as the planner gives them.
Result<PlannedScene> planAsRival(const std::string& planner, const OpenedScene& opened,
                                 const JobContext& job);

/// The metrics of a trajectory of any origin in this scene, as planAsRival() has them, and under
/// "ledger" for each target the frame that shows it best (-1: none). Errors: Usage, Cancelled.
Result<nlohmann::json> judgeTrajectory(const OpenedScene& opened, const Trajectory& trajectory,
                                       const JobContext& job);

/// All metrics that `plan --planner` gives, with values of no meaning: to check names before any
/// work. The planner must be known.
nlohmann::json metricsOf(const std::string& planner);

/// A rival's metrics for a person, one a line.
std::string judgedTable(const nlohmann::json& metrics);

}  // namespace dollytrack::cli
