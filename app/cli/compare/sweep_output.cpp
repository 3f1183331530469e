#include "app/cli/compare/sweep_output.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::cli {
namespace {

const planning::MetricInfo& metricAt(int index) {
    return planning::plannerMetricInfos()[index];
}

std::optional<double> shown(int metric, const SweepPoint& point) {
    const auto& value = point.metrics[metric];
    if (!value) return value;
    return metricAt(metric).unit == "%" ? 100.0 * *value : *value;
}

std::string withUnit(std::string_view name, std::string_view unit) {
    return unit.empty() ? std::string(name) : fmt::format("{} ({})", name, unit);
}

std::vector<std::string> stageNames(const std::vector<SweepPoint>& points) {
    std::vector<std::string> names;
    for (const SweepPoint& point : points) {
        for (const StageTime& stage : point.stages) {
            if (std::find(names.begin(), names.end(), stage.name) == names.end()) {
                names.push_back(stage.name);
            }
        }
    }
    return names;
}

/// Curve name: the planner, and the values of all parameters but the first.
std::string curveName(const std::vector<SweptParameter>& parameters, const SweepPoint& point) {
    std::string name = point.planner;
    for (std::size_t i = 1; i < parameters.size(); ++i) {
        name += ", " + parameters[i].name + "=" + point.values[i];
    }
    return name;
}

}  // namespace

std::string sweepCsv(const std::vector<SweptParameter>& parameters,
                     const std::vector<SweepPoint>& points) {
    const std::vector<std::string> stages = stageNames(points);
    std::string text;
    for (const SweptParameter& parameter : parameters) text += parameter.name + ",";
    text += "planner";
    for (const planning::MetricInfo& metric : planning::plannerMetricInfos()) {
        text += fmt::format(",{}", metric.name);
    }
    for (const std::string& stage : stages) text += ",stage_" + stage + "_ms";
    text += "\n";
    for (const SweepPoint& point : points) {
        for (const std::string& value : point.values) text += value + ",";
        text += point.planner;
        for (const auto& value : point.metrics) {
            text += value ? fmt::format(",{:.9g}", *value) : ",";
        }
        for (const std::string& name : stages) {
            const auto at =
                std::find_if(point.stages.begin(), point.stages.end(),
                             [&](const StageTime& stage) { return stage.name == name; });
            text += at != point.stages.end() ? fmt::format(",{:.3f}", at->milliseconds) : ",";
        }
        text += "\n";
    }
    return text;
}

std::string sweepTable(const std::vector<SweptParameter>& parameters,
                       const std::vector<SweepPoint>& points, const std::vector<int>& metrics) {
    std::vector<std::vector<std::string>> rows(1);
    for (const SweptParameter& one : parameters) rows[0].push_back(withUnit(one.name, one.unit));
    rows[0].emplace_back("planner");
    for (const int metric : metrics) {
        rows[0].push_back(withUnit(metricAt(metric).name, metricAt(metric).unit));
    }
    for (const SweepPoint& point : points) {
        rows.push_back(point.values);
        rows.back().push_back(point.planner);
        for (const int metric : metrics) {
            const auto value = shown(metric, point);
            rows.back().push_back(value ? fmt::format("{:.4g}", *value) : "-");
        }
    }
    std::string text;
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::size_t width = 0;
            for (const auto& other : rows) width = std::max(width, other[i].size());
            text += fmt::format("{:>{}}", row[i], width + 2);
        }
        text += "\n";
    }
    return text;
}

Status checkAxis(const SweptParameter& parameter) {
    const bool numbers =
        std::all_of(parameter.values.begin(), parameter.values.end(),
                    [](const std::string& value) { return finiteNumber(value).has_value(); });
    if (numbers) return {};
    return fail(
        ErrorCode::Usage,
        "Only a number can be plotted along an axis; make this parameter the second --param.",
        parameter.name);
}

render::Figure sweepFigure(const std::string& title, const std::vector<SweptParameter>& parameters,
                           const std::vector<SweepPoint>& points, const std::vector<int>& metrics) {
    render::Figure figure;
    figure.title = title;
    for (const int metric : metrics) {
        render::Chart chart;
        chart.title = metricAt(metric).name;
        chart.y_label = withUnit(metricAt(metric).title, metricAt(metric).unit);
        chart.x_label = withUnit(parameters.front().name, parameters.front().unit);
        for (const SweepPoint& point : points) {
            const double x = finiteNumber(point.values.front()).value_or(0.0);
            const std::string name = curveName(parameters, point);
            auto at = std::find_if(chart.curves.begin(), chart.curves.end(),
                                   [&](const render::Curve& curve) { return curve.name == name; });
            if (at == chart.curves.end()) at = chart.curves.insert(at, render::Curve{name, {}, {}});
            at->x.push_back(x);
            at->y.push_back(shown(metric, point));
        }
        figure.charts.push_back(std::move(chart));
    }
    return figure;
}

}  // namespace dollytrack::cli
