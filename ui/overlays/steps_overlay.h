#pragma once

#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

#include <cstddef>
#include <string>

namespace dollytrack::ui {

/// The roadmap as it was after the first `count` steps of Plan::roadmap.steps, with the last of
/// them emphasised. Any count may follow any other, so that a person can go forward and back.
[[nodiscard]] PlanLayer stepsLayer(const Plan& plan, std::size_t count);

/// A step in one sentence: "Near: window_seat, 2.00 m away, cost 3.10 = 2.00 distance + 0.60 size +
/// 0.50 turn."
[[nodiscard]] std::string describe(const Scene& scene, const Plan& plan, const AlgorithmStep& step);

/// What a position point looks at, by name: "sofa", or "cup and 3 more".
[[nodiscard]] std::string nameOf(const Scene& scene, const Plan& plan, int position_point);

}  // namespace dollytrack::ui
