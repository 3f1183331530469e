#pragma once

#include "planning/baselines/baseline_scene.h"
#include "planning/baselines/planned_motion.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::planning {

/// A planner: Dollytrack or a baseline, usually the reimplemented sampler of a published dataset,
/// so that all can be measured in the same scene by the same code.
struct Planner {
    std::string_view name;    // name on the command line
    std::string_view text;    // one-line description
    std::string_view source;  // publication
    /// What the method itself says about collisions. Real collisions are measured.
    std::string_view collision_promise;

    /// Plans a trajectory. The result depends only on scene, parameters and seed, not on the number
    /// of threads. Errors: Cancelled, and those of Pipeline::run().
    Result<PlannedMotion> (*plan)(const MappedScene& scene, const PlanParams& params, int seed,
                                  const JobContext& job);
};

/// All planners, Dollytrack first.
[[nodiscard]] std::span<const Planner> planners();

/// Controls and generators of test views. They are not baselines: choosePlanners() does not accept
/// them; the option --planner does.
[[nodiscard]] std::span<const Planner> auxiliaryPlanners();

/// The planners with these names, in the table's order; "all" selects all. Error: Usage, with the
/// closest name.
[[nodiscard]] Result<std::vector<const Planner*>> choosePlanners(
    const std::vector<std::string>& names);

}  // namespace dollytrack::planning
