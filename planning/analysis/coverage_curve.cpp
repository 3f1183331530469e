#include "planning/analysis/coverage_curve.h"

#include "engine/plan/plan.h"
#include "planning/pipeline/pipeline.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dollytrack::planning {
namespace {

constexpr int kSteps = 12;
constexpr int kUsualFrames = 300;  // the budget of planner comparisons

CoveragePoint pointOf(const Plan& plan, const PathParams& path, int max_frames) {
    CoveragePoint point;
    point.max_frames = max_frames;
    point.max_length_m = path.max_length_m;
    point.frames = static_cast<int>(plan.trajectory.frames.size());
    point.path_length_m = plan.trajectory_metrics.path_length_m;
    point.captured = plan.capture_metrics.captured;
    point.well_captured = plan.capture_metrics.well_captured;
    point.capture_rate = plan.capture_metrics.capture_rate;
    point.well_captured_rate = plan.capture_metrics.well_captured_rate;
    if (plan.surface) {
        point.surface_seen_rate = plan.surface->rateOf(plan.surface->seen);
        point.surface_covered_rate = plan.surface->rateOf(plan.surface->covered);
    }
    return point;
}

/// Even steps, and the first few frames, which add the most each.
std::set<int> frameBudgets(const PlanParams& params, const Plan& plan) {
    const int most = params.timing.max_frames > 0
                         ? params.timing.max_frames
                         : std::max(kUsualFrames, static_cast<int>(plan.key_frames.size()));
    std::set<int> budgets = {1, std::min(2, most), std::min(5, most), most};
    const auto keys = std::min(most, static_cast<int>(plan.key_frames.size()));
    for (int i = 1; i <= kSteps; ++i) budgets.insert(std::max(1, keys * i / kSteps));
    return budgets;
}

}  // namespace

Result<CoverageCurves> coverageCurves(Pipeline& pipeline, const PlanParams& params,
                                      const PlanEdits& edits, const Plan& plan,
                                      const JobContext& job) {
    if (edits.motion) {
        return fail(ErrorCode::Usage,
                    "The project has a given camera motion, to which budgets do not apply; remove "
                    "it with the operation clear_motion.",
                    "coverage");
    }
    CoverageCurves curves;
    const auto planWithin = [&](int max_frames, double max_length_m, const JobContext& part) {
        PlanParams within = params;
        within.timing.max_frames = max_frames;
        within.path.max_length_m = max_length_m;
        return pipeline.run(within, edits, part).map([&](const std::shared_ptr<const Plan>& made) {
            return pointOf(*made, within.path, max_frames);
        });
    };
    const std::set<int> budgets = frameBudgets(params, plan);
    const double planned_m = plan.trajectory_metrics.path_length_m;
    const int lengths = planned_m > 0.0 ? kSteps : 0;
    const double count = static_cast<double>(budgets.size()) + lengths;
    double done = 0.0;
    const auto nextPart = [&] {
        const JobContext part = job.stage(done / count, (done + 1.0) / count, "coverage");
        done += 1.0;
        return part;
    };
    for (const int budget : budgets) {
        const auto point = planWithin(budget, params.path.max_length_m, nextPart());
        if (!point) return tl::unexpected(point.error());
        curves.by_frames.push_back(*point);
    }
    for (int i = 1; i <= lengths; ++i) {
        // Walks are measured before smoothing shortens them, so the plan's own length could be too
        // short for its own path: the last point is the plan itself.
        const JobContext part = nextPart();
        if (i == lengths) {
            curves.by_length.push_back(pointOf(plan, params.path, params.timing.max_frames));
            break;
        }
        const double metres = std::ceil(100.0 * planned_m * i / lengths) / 100.0;
        const auto point = planWithin(params.timing.max_frames, metres, part);
        if (!point) return tl::unexpected(point.error());
        curves.by_length.push_back(*point);
    }
    return curves;
}

}  // namespace dollytrack::planning
