#include "engine/math/quantile.h"
#include "planning/baselines/planner_metrics.h"

#include <fmt/format.h>

#include <numeric>

namespace dollytrack::planning {
namespace {

template <class Combine>
MetricsRow byColumn(const std::vector<MetricsRow>& rows, Combine&& combine) {
    MetricsRow result(plannerMetricInfos().size());
    for (std::size_t column = 0; column < result.size(); ++column) {
        std::vector<double> values;
        for (const MetricsRow& row : rows) {
            if (row[column]) values.push_back(*row[column]);
        }
        if (!values.empty()) result[column] = combine(values);
    }
    return result;
}

}  // namespace

std::string metricNumber(const MetricInfo& info, const std::optional<double>& value) {
    if (!value) return "-";
    if (info.unit == "%") return fmt::format("{:.1f}", 100.0 * *value);
    const bool is_score = info.name.ends_with("score");
    if ((info.unit.empty() && !is_score) || info.unit == "ms") return fmt::format("{:.0f}", *value);
    if (info.unit == "deg/s" || info.unit == "s") return fmt::format("{:.1f}", *value);
    if (info.name == "path_length_m") return fmt::format("{:.1f}", *value);
    return fmt::format("{:.2f}", *value);
}

const std::vector<MetricInfo>& plannerMetricInfos() {
    static const std::vector<MetricInfo> metrics = [] {
        std::vector<MetricInfo> list;
        const PlannerMetrics none;
        visitPlannerMetrics(none,
                            [&](const MetricInfo& info, const auto&) { list.push_back(info); });
        return list;
    }();
    return metrics;
}

MetricsRow toRow(const PlannerMetrics& measured) {
    MetricsRow row;
    visitPlannerMetrics(measured, [&](const MetricInfo&, const auto& value) {
        if constexpr (requires { value.has_value(); }) {
            row.push_back(value);
        } else {
            row.emplace_back(static_cast<double>(value));
        }
    });
    return row;
}

MetricsRow medianOf(const std::vector<MetricsRow>& rows) {
    return byColumn(rows, [](const std::vector<double>& values) { return median(values); });
}

MetricsRow meanOf(const std::vector<MetricsRow>& rows) {
    return byColumn(rows, [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) /
               static_cast<double>(values.size());
    });
}

}  // namespace dollytrack::planning
