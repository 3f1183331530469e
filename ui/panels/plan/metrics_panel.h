#pragma once

#include "engine/plan/plan.h"

#include <string>

namespace dollytrack::ui {

struct MetricsView {
    const Plan* plan = nullptr;
    bool measured = false;  // the capture metrics belong to this trajectory
    bool busy = false;
    double fraction = 0.0;
    std::string stage;
    const Scene* scene = nullptr;
    double last_run_ms = 0.0;  // from the change to the trajectory on the screen
};

struct MetricsActions {
    int select_object = 0;  // id of an uncaptured object
};

/// The columns of the paper's Table 2, the rates around them, the time each stage took, and what
/// is not captured with the reason.
MetricsActions drawMetricsPanel(const MetricsView& view);

}  // namespace dollytrack::ui
