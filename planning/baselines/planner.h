#pragma once

#include "planning/baselines/flight.h"
#include "planning/baselines/rival_scene.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::planning {

/// A way to decide where the camera goes: ours, and those of published datasets, rebuilt so that
/// all can be measured in the same scene by the same judge. A new one is a file and a row.
struct Planner {
    std::string_view name;    // as one asks for it
    std::string_view text;    // what it does, for people
    std::string_view source;  // where it was published
    /// What the method itself says of collisions; what it does is measured.
    std::string_view collision_promise;

    /// The same scene, parameters and seed give the same flight, with any number of threads.
    /// Errors: Cancelled, and what Pipeline::run() gives.
    Result<Flight> (*plan)(const RivalScene& scene, const PlanParams& params, int seed,
                           const JobContext& job);
};

/// All there are, ours first.
[[nodiscard]] std::span<const Planner> planners();

/// Controls and generators of test views, which are not baselines: choosePlanners() does not know
/// them; the option --planner finds them by name.
[[nodiscard]] std::span<const Planner> auxiliaryPlanners();

/// Those named, in the table's order; all for "all". Error: Usage, with the closest name.
[[nodiscard]] Result<std::vector<const Planner*>> choosePlanners(
    const std::vector<std::string>& names);

}  // namespace dollytrack::planning
