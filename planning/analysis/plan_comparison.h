#pragma once

#include "engine/camera/trajectory.h"
#include "planning/baselines/planner_metrics.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::planning {

/// A plan's numbers for a comparison with another plan: its metrics (metricsJson() or those of a
/// project's result) and its trajectory.
struct ComparablePlan {
    const nlohmann::json& metrics;
    const Trajectory& trajectory;
};

/// A metric with its values in two plans, A and B. A value is empty if its plan lacks the metric.
struct ComparedMetric {
    MetricInfo info;
    std::optional<double> a;
    std::optional<double> b;

    /// The title with the unit: "captured (%)".
    [[nodiscard]] std::string title() const;
    /// Whether the values differ as texts, that is, as they are shown.
    [[nodiscard]] bool differs() const;
    /// Whether A is better than B (1), worse (-1), or neither (0).
    [[nodiscard]] int betterA() const;
    /// A - B with its sign, of the values as shown: "+2.4"; empty if they do not differ or one is
    /// missing.
    [[nodiscard]] std::string differenceText() const;
};

/// The metrics that at least one of the plans has, in a fixed order.
std::vector<ComparedMetric> comparePlans(const ComparablePlan& a, const ComparablePlan& b);

}  // namespace dollytrack::planning
