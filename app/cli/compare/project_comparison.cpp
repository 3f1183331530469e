#include "app/cli/compare/project_comparison.h"

#include "app/cli/compare/comparison.h"
#include "app/cli/plan/planned_scene.h"
#include "app/project/read_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace dollytrack::cli {
namespace {

using planning::Better;
using planning::ComparedMetric;

std::string_view directionOf(Better better) {
    if (better == Better::Neither) return "";
    return better == Better::Higher ? "higher" : "lower";
}

}  // namespace

Result<ProjectComparison> compareProjects(const std::vector<std::string>& projects,
                                          const SceneArguments& each, const JobContext& job) {
    std::vector<PlannedScene> plans;
    std::vector<nlohmann::json> imports;
    for (std::size_t i = 0; i < projects.size(); ++i) {
        const double begin = 0.5 * static_cast<double>(i);
        SceneArguments one = each;
        one.path = projects[i];
        if (!isProjectFile(one.path)) {
            return fail(
                ErrorCode::Usage,
                "This is not a project; make one with 'dollytrack plan SCENE -o FILE.dolly'.",
                one.path);
        }
        auto planned =
            openScene(one, job.stage(begin, begin + 0.2, "loading")).and_then([&](auto&& opened) {
                imports.push_back(opened.import);
                return planOrReuse(opened, job.stage(begin + 0.2, begin + 0.5, "planning"));
            });
        if (!planned) return tl::unexpected(std::move(planned.error()));
        plans.push_back(std::move(*planned));
    }
    if (plans[0].scene->source_sha256 != plans[1].scene->source_sha256 ||
        imports[0] != imports[1]) {
        return fail(ErrorCode::Usage,
                    "The projects have different scenes or import settings; compare projects of "
                    "one scene.",
                    "--projects");
    }
    return ProjectComparison{projects[0], projects[1],
                             planning::comparePlans({plans[0].metrics, plans[0].trajectory},
                                                    {plans[1].metrics, plans[1].trajectory})};
}

std::string comparisonTable(const ProjectComparison& comparison) {
    std::string text = fmt::format("A: {}\nB: {}\n", comparison.a, comparison.b);
    text += fmt::format("  {:<24}{:>10}{:>10}{:>10}\n", "", "A", "B", "A - B");
    for (const ComparedMetric& metric : comparison.metrics) {
        const int better = metric.betterA();
        text += fmt::format("  {:<24}{:>10}{:>10}", metric.title(),
                            planning::metricNumber(metric.info, metric.a),
                            planning::metricNumber(metric.info, metric.b));
        if (metric.a && metric.b && metric.differs()) {
            text += fmt::format("{:>10}", metric.differenceText());
        }
        if (better != 0) text += better > 0 ? "  A is better" : "  B is better";
        text += '\n';
    }
    const bool missing = std::ranges::any_of(
        comparison.metrics, [](const ComparedMetric& metric) { return !metric.a || !metric.b; });
    if (missing)
        text +=
            "-: not available; 'dollytrack plan --quality' measures overlap, trackability and "
            "surface\n";
    return text;
}

std::string comparisonJson(const ProjectComparison& comparison) {
    const auto number = [](const std::optional<double>& value) {
        return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
    };
    nlohmann::ordered_json json = {{"a", comparison.a}, {"b", comparison.b}};
    json["metrics"] = nlohmann::ordered_json::array();
    for (const ComparedMetric& metric : comparison.metrics) {
        json["metrics"].push_back({{"name", metric.info.name},
                                   {"unit", metric.info.unit == "%" ? "" : metric.info.unit},
                                   {"better", directionOf(metric.info.better)},
                                   {"a", number(metric.a)},
                                   {"b", number(metric.b)}});
    }
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string comparisonCsv(const ProjectComparison& comparison) {
    const auto number = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.9g}", *value) : std::string();
    };
    std::string text =
        fmt::format("metric,better,{},{}\n", csvField(comparison.a), csvField(comparison.b));
    for (const ComparedMetric& metric : comparison.metrics) {
        fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", metric.info.name,
                       directionOf(metric.info.better), number(metric.a), number(metric.b));
    }
    return text;
}

}  // namespace dollytrack::cli
