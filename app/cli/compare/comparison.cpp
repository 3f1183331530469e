#include "app/cli/compare/comparison.h"

#include "engine/core/log.h"
#include "engine/geometry/ray_caster.h"
#include "planning/analysis/capture_bound.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"

#include <fmt/format.h>

#include <chrono>
#include <limits>

namespace dollytrack::cli {
namespace {

using planning::MappedScene;
using planning::MetricsRow;
using planning::PlannedMotion;
using planning::PlannerMetrics;

double millisecondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

class SceneComparison {
  public:
    SceneComparison(const MappedScene& scene, const planning::PlanParams& params)
        : scene_(scene), params_(params), best_(bestCaptures(*scene.scene, {})) {}

    /// Evaluates one planner. A failed seed is skipped; cancellation ends the comparison.
    Status run(const planning::Planner& planner, int seeds, const JobContext& job) {
        std::vector<MetricsRow> rows;
        for (int i = 0; i < seeds; ++i) {
            const JobContext part = job.stage(static_cast<double>(i) / seeds,
                                              static_cast<double>(i + 1) / seeds, planner.name);
            part.report(0.0);
            const auto begin = std::chrono::steady_clock::now();
            Result<PlannedMotion> motion =
                planner.plan(scene_, params_, params_.seed + i, part.stage(0.0, 0.6, planner.name));
            if (!motion && motion.error().code == ErrorCode::Cancelled) {
                return tl::unexpected(std::move(motion.error()));
            }
            if (!motion) {
                log::warn("compare",
                          fmt::format("planner {} found no trajectory for seed {}: {}",
                                      planner.name, params_.seed + i, describe(motion.error())));
                ++result_.failures;
                continue;
            }
            if (!motion->plan_ms) motion->plan_ms = millisecondsSince(begin);
            Result<MetricsRow> row = measureOne(*motion, part.stage(0.6, 1.0, planner.name));
            if (!row) return tl::unexpected(std::move(row.error()));
            rows.push_back(std::move(*row));
        }
        if (!rows.empty()) {
            result_.rows.push_back({std::string(planner.name), planning::medianOf(rows)});
        }
        return {};
    }

    Status add(const ExternalTrajectory& given, const JobContext& job) {
        Result<MetricsRow> row = measureOne(given.motion, job);
        if (!row) return tl::unexpected(std::move(row.error()));
        const auto& metrics = planning::plannerMetricInfos();
        for (std::size_t i = 0; i < metrics.size(); ++i) {
            if (metrics[i].name != "outside_rate" || !(*row)[i] || *(*row)[i] < 0.9) continue;
            log::warn("compare", given.name +
                                     ": nearly all of its poses are outside the rooms; check that "
                                     "it belongs to this scene, and --trajectory-world");
        }
        result_.rows.push_back({given.name, std::move(*row)});
        return {};
    }

    Status addBound(const JobContext& job) {
        Plan found;
        found.captures = best_;
        const auto begin = std::chrono::steady_clock::now();
        const auto bound = planning::boundCaptures(
            {*scene_.views, *scene_.free_space, *scene_.sphere}, found, params_.seed, job);
        if (!bound) return tl::unexpected(bound.error());
        MetricsRow row;
        for (const planning::MetricInfo& metric : planning::plannerMetricInfos()) {
            std::optional<double> value;
            if (metric.name == "objects") value = static_cast<double>(best_.size());
            if (metric.name == "capture_rate") value = bound->capturable_rate;
            if (metric.name == "well_captured_rate") value = bound->well_capturable_rate;
            if (metric.name == "plan_ms") value = millisecondsSince(begin);
            row.push_back(value);
        }
        result_.rows.push_back({"bound", std::move(row)});
        return {};
    }

    ComparedScene take() { return std::move(result_); }

  private:
    Result<MetricsRow> measureOne(const PlannedMotion& motion, const JobContext& job) {
        return planning::measurePlannedMotion(scene_, motion, job)
            .map([&](const PlannerMetrics& measured) {
                for (std::size_t i = 0; i < best_.size(); ++i) {
                    best_[i].captured |= measured.objects[i].captured;
                    best_[i].well_captured |= measured.objects[i].well_captured;
                }
                return planning::toRow(measured);
            });
    }

    const MappedScene& scene_;
    const planning::PlanParams& params_;
    std::vector<ObjectCapture> best_;  // best captures over all trajectories
    ComparedScene result_;
};

}  // namespace

Result<ComparedScene> compareIn(std::shared_ptr<const Scene> scene, const PlanEdits& edits,
                                const planning::PlanParams& params, const ComparisonOrder& order,
                                const std::vector<ExternalTrajectory>& given,
                                const JobContext& job) {
    if (order.seeds > 1 && params.seed > std::numeric_limits<int>::max() - (order.seeds - 1)) {
        return fail(
            ErrorCode::Usage,
            fmt::format("There are fewer than {} seeds from {} on; start from a smaller --seed.",
                        order.seeds, params.seed),
            "--seeds");
    }
    const auto begin = std::chrono::steady_clock::now();
    const auto map =
        planning::mapScene(std::move(scene), edits, params, job.stage(0.0, 0.1, "free space"));
    if (!map) return tl::unexpected(map.error());
    const double map_ms = millisecondsSince(begin);
    SceneComparison comparison(*map, params);
    const std::size_t total = order.planners.size() + given.size() + (order.bound ? 1 : 0);
    std::size_t done = 0;
    const auto next = [&](std::string_view what) {
        const auto share = [&](std::size_t i) {
            return 0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(total);
        };
        ++done;
        return job.stage(share(done - 1), share(done), what);
    };
    for (const planning::Planner* planner : order.planners) {
        if (Status status = comparison.run(*planner, order.seeds, next(planner->name)); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    for (const ExternalTrajectory& one : given) {
        if (Status status = comparison.add(one, next(one.name)); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    if (order.bound) {
        if (Status status = comparison.addBound(next("dense search")); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    ComparedScene compared = comparison.take();
    compared.map_ms = map_ms;
    return compared;
}

ComparedScene meanOver(const std::vector<ComparedScene>& scenes) {
    ComparedScene mean;
    mean.scene = fmt::format("mean of {} scenes", scenes.size());
    std::vector<std::vector<MetricsRow>> rows;  // metric rows by planner
    for (const ComparedScene& scene : scenes) {
        mean.map_ms += scene.map_ms / static_cast<double>(scenes.size());
        for (const ComparedRow& row : scene.rows) {
            std::size_t at = 0;
            while (at < mean.rows.size() && mean.rows[at].planner != row.planner) ++at;
            if (at == mean.rows.size()) {
                mean.rows.push_back({row.planner, {}});
                rows.emplace_back();
            }
            rows[at].push_back(row.values);
        }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) mean.rows[i].values = planning::meanOf(rows[i]);
    return mean;
}

}  // namespace dollytrack::cli
