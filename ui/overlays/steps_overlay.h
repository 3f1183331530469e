#pragma once

#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

#include <cstddef>
#include <string>

namespace dollytrack::ui {

/// The roadmap after the first `count` steps of Plan::roadmap.steps, with the last step
/// highlighted. Each call is independent, so steps can be shown in any order.
[[nodiscard]] PlanLayer stepsLayer(const Plan& plan, std::size_t count);

/// One step as a sentence: "Near: window_seat, 2.00 m away, cost 3.10 = 2.00 distance + 0.60 size +
/// 0.50 turn."
[[nodiscard]] std::string describe(const Scene& scene, const Plan& plan, const AlgorithmStep& step);

/// Names of the objects that a position point observes: "sofa", or "cup and 3 more".
[[nodiscard]] std::string nameOf(const Scene& scene, const Plan& plan, int position_point);

}  // namespace dollytrack::ui
