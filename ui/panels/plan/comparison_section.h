#pragma once

#include "planning/analysis/plan_comparison.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// Input of the comparison of the current plan (A) with the one that is kept (B).
struct ComparisonView {
    bool has_kept = false;
    std::string kept_name;
    /// Empty while A is not measured.
    std::vector<planning::ComparedMetric> metrics;
    std::string why_not_keep;  // why the current plan cannot be kept; or empty
    std::string why_not_swap;
    std::string why_not_open;  // why no other project can be opened as B; or empty
    std::string reading;       // name of the project that is being read as B; empty: none
};

struct ComparisonActions {
    bool keep = false;  // keep the current plan as B
    bool open = false;  // choose another project of this scene, whose plan becomes B
    bool swap = false;
    bool drop = false;
    bool cancel_reading = false;
};

/// Draws the buttons and, while a plan is kept, a table of both plans' metrics. Those that are
/// equal are dim; differences have the colour of better or worse.
ComparisonActions drawComparison(const ComparisonView& view);

}  // namespace dollytrack::ui
