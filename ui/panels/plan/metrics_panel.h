#pragma once

#include "engine/plan/plan.h"
#include "ui/panels/plan/comparison_section.h"

#include <string>

namespace dollytrack::ui {

struct MetricsView {
    const Plan* plan = nullptr;
    bool measured = false;  // `plan` has capture metrics for its current trajectory
    bool busy = false;
    double fraction = 0.0;
    std::string stage;
    const Scene* scene = nullptr;
    double last_run_ms = 0.0;  // time from the change to the new trajectory
    ComparisonView comparison = {};
};

struct MetricsActions {
    int select_object = 0;  // id of a clicked uncaptured object; 0: none
    ComparisonActions comparison;
};

/// Draws the comparison with another plan, the columns of the paper's Table 2, related rates, the
/// duration of each stage, and the uncaptured objects with their reasons.
MetricsActions drawMetricsPanel(const MetricsView& view);

}  // namespace dollytrack::ui
