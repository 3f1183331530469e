#include "app/cli/plan/baseline_plan.h"

#include "app/cli/plan/metrics_table.h"
#include "engine/plan/plan_json.h"
#include "planning/baselines/planner.h"
#include "planning/baselines/planner_metrics.h"
#include "planning/free_space/free_space.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace dollytrack::cli {
namespace {

Result<const planning::Planner*> findPlanner(const std::string& name) {
    std::string known;
    for (const planning::Planner& planner : planning::planners()) {
        if (planner.name == name) return &planner;
        known += (known.empty() ? "" : ", ") + std::string(planner.name);
    }
    for (const planning::Planner& planner : planning::auxiliaryPlanners()) {
        if (planner.name == name) return &planner;
    }
    if (name == "all" || name.empty()) {
        return fail(ErrorCode::Usage, "Name one planner of " + known + ".", "--planner");
    }
    auto refused = planning::choosePlanners({name});
    return fail(ErrorCode::Usage, refused ? "" : refused.error().message, name);
}

nlohmann::json plannerMetricsJson(const planning::PlannerMetrics& measured,
                                  const std::string& planner) {
    nlohmann::json metrics = captureMetricsJson(measured.captures);
    const auto& infos = planning::plannerMetricInfos();
    const planning::MetricsRow row = planning::toRow(measured);
    for (std::size_t i = 0; i < infos.size(); ++i) {
        nlohmann::json value;
        if (row[i]) value = *row[i];
        metrics[std::string(infos[i].name)] = std::move(value);
    }
    // Integers instead of the table's real numbers.
    metrics["objects"] = measured.captures.objects;
    metrics["frames"] = measured.frames;
    metrics["planner"] = planner;
    return metrics;
}

}  // namespace

void addPlannerArgument(CLI::App& command, std::string& planner) {
    command
        .add_option("--planner", planner,
                    "Planner to use (see 'dollytrack compare --list'); default: dollytrack")
        ->type_name("NAME");
}

Result<bool> namesBaseline(const std::string& planner) {
    return findPlanner(planner).map(
        [](const planning::Planner* found) { return found != &planning::planners().front(); });
}

Result<PlannedScene> planWithBaseline(const std::string& name, const OpenedScene& opened,
                                      const JobContext& job) {
    const auto planner = findPlanner(name);
    if (!planner) return tl::unexpected(planner.error());
    const auto map = planning::mapScene(opened.scene, opened.plan_edits, opened.params,
                                        job.stage(0.0, 0.2, "free space"));
    if (!map) return tl::unexpected(map.error());
    Result<planning::PlannedMotion> motion =
        (*planner)->plan(*map, opened.params, opened.params.seed, job.stage(0.2, 0.8, "planning"));
    if (!motion) return tl::unexpected(std::move(motion.error()));
    const auto measured =
        planning::measurePlannedMotion(*map, *motion, job.stage(0.8, 1.0, "metrics"));
    if (!measured) return tl::unexpected(measured.error());
    PlannedScene planned;
    planned.scene = opened.scene;
    planned.params = opened.params;
    planned.trajectory = std::move(motion->trajectory);
    for (const planning::Room& room : map->free_space->rooms()) planned.rooms.push_back(room.box);
    planned.metrics = plannerMetricsJson(*measured, name);
    if (const auto share = map->free_space->scannedShare()) {
        planned.metrics["scanned_share"] = *share;
    }
    return planned;
}

Result<nlohmann::json> evaluateTrajectory(const OpenedScene& opened, const Trajectory& trajectory,
                                          const JobContext& job) {
    if (Status status = planning::validate(opened.params); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const auto map = planning::mapScene(opened.scene, opened.plan_edits, opened.params,
                                        job.stage(0.0, 0.4, "free space"));
    if (!map) return tl::unexpected(map.error());
    planning::PlannedMotion motion;
    motion.trajectory = trajectory;
    const auto measured =
        planning::measurePlannedMotion(*map, motion, job.stage(0.4, 1.0, "metrics"));
    if (!measured) return tl::unexpected(measured.error());
    nlohmann::json metrics = plannerMetricsJson(*measured, "given");
    metrics.erase("planner");
    nlohmann::json& ledger = metrics["ledger"] = nlohmann::json::array();
    for (const ObjectCapture& one : measured->objects) {
        ledger.push_back({{"object", opened.scene->object(one.object_id).name},
                          {"id", one.object_id},
                          {"captured", one.captured},
                          {"well_captured", one.well_captured},
                          {"frame", one.best.frame},
                          {"visible_fraction", one.best.visible_fraction},
                          {"box_share", one.best.box_share}});
    }
    return metrics;
}

nlohmann::json metricsOf(const std::string& planner) {
    nlohmann::json metrics;
    if (planner == planning::planners().front().name) {
        Plan plan;
        // Only plans whose objective includes surface, or with trackability, have these metrics.
        plan.surface.emplace();
        plan.trajectory_metrics.trackable_rate = 0.0;
        metrics = metricsJson(Scene{}, plan);
    } else {
        metrics = plannerMetricsJson({}, planner);
        for (nlohmann::json& value : metrics) {
            if (value.is_null()) value = 0.0;
        }
    }
    metrics["scanned_share"] = 0.0;  // only scans have this metric
    return metrics;
}

std::string plannerMetricsTable(const nlohmann::json& metrics) {
    std::string text;
    if (const std::string scanned = scannedText(metrics); !scanned.empty()) {
        text += fmt::format("  {:<22} {}\n", "scan", scanned);
    }
    for (const planning::MetricInfo& info : planning::plannerMetricInfos()) {
        const nlohmann::json& value = metrics.at(std::string(info.name));
        if (value.is_null()) continue;
        const bool rate = info.unit == "%";
        text += fmt::format("  {:<22} {:.4g} {}\n", info.name,
                            value.get<double>() * (rate ? 100.0 : 1.0), info.unit);
    }
    return text;
}

}  // namespace dollytrack::cli
