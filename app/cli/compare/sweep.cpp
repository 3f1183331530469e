#include "app/cli/compare/sweep.h"

#include "planning/baselines/dollytrack_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

namespace dollytrack::cli {
namespace {

constexpr int kMostValues = 10'000;

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while (true) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string::npos) return parts;
        begin = end + 1;
    }
}

Result<std::vector<std::string>> valuesOf(const std::string& text, const std::string& where) {
    const std::vector<std::string> range = split(text, ':');
    if (range.size() == 1) return split(text, ',');
    std::vector<double> numbers;
    for (const std::string& part : range) {
        if (const auto number = finiteNumber(part)) numbers.push_back(*number);
    }
    if (range.size() != 3 || numbers.size() != 3 || numbers[2] <= 0.0 || numbers[1] < numbers[0]) {
        return fail(ErrorCode::Usage, "A range is FROM:TO:STEP with rising numbers.", where);
    }
    const double steps = std::floor((numbers[1] - numbers[0]) / numbers[2] + 1e-6);
    if (steps >= kMostValues) {
        return fail(ErrorCode::Usage, fmt::format("That is more than {} values.", kMostValues),
                    where);
    }
    std::vector<std::string> values;
    for (int i = 0; i <= static_cast<int>(steps); ++i) {
        values.push_back(fmt::format("{:.9g}", numbers[0] + i * numbers[2]));
    }
    return values;
}

/// The assignments that can change the imported scene.
std::vector<std::string> ofImport(std::vector<std::string> assignments) {
    std::erase_if(assignments, [](const std::string& text) {
        return !text.starts_with("small_volume_m3=") && !text.starts_with("size_ratio=");
    });
    return assignments;
}

/// A point without metrics, for a planner that failed.
SweepPoint gapOf(const planning::Planner& planner, const Error& error) {
    SweepPoint point;
    point.planner = planner.name;
    point.metrics.resize(planning::plannerMetricInfos().size());
    point.gap = describe(error);
    return point;
}

}  // namespace

std::optional<double> finiteNumber(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

Result<SweptParameter> parseSweptParameter(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        return fail(ErrorCode::Usage, "Give --param as NAME=FROM:TO:STEP or NAME=A,B,C.", text);
    }
    SweptParameter swept;
    swept.name = text.substr(0, equals);
    auto values = valuesOf(text.substr(equals + 1), text);
    if (!values) return tl::unexpected(std::move(values.error()));
    swept.values = std::move(*values);
    planning::PlanParams params;
    const FieldList fields = planning::listFields(params);
    for (const std::string& value : swept.values) {
        if (Status status = setField(fields, swept.name + "=" + value); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    for (const Field& field : fields) {
        if (field.name == swept.name) swept.unit = field.unit();
    }
    return swept;
}

Status Sweeper::open(const std::vector<std::string>& assignments, const JobContext& job) {
    std::vector<std::string> with = ofImport(assignments);
    if (opened_ && with == opened_with_) return {};
    SceneArguments arguments = arguments_;
    arguments.assignments.insert(arguments.assignments.end(), with.begin(), with.end());
    Result<OpenedScene> opened = openScene(arguments, job);
    if (!opened) return tl::unexpected(std::move(opened.error()));
    opened_ = std::move(*opened);
    opened_with_ = std::move(with);
    pipeline_ = std::make_unique<planning::Pipeline>(opened_->scene);
    mapped_.reset();
    return {};
}

Status Sweeper::map(const planning::PlanParams& params, const JobContext& job) {
    if (mapped_ && mapped_camera_ == params.camera && mapped_space_ == params.free_space) return {};
    auto mapped = planning::mapScene(opened_->scene, opened_->plan_edits, params, job);
    if (!mapped) return tl::unexpected(std::move(mapped.error()));
    mapped_ = std::move(*mapped);
    mapped_camera_ = params.camera;
    mapped_space_ = params.free_space;
    return {};
}

Result<planning::PlannedMotion> Sweeper::planMotion(const planning::Planner& planner,
                                                    const planning::PlanParams& params,
                                                    std::vector<StageTime>& stages,
                                                    const JobContext& job) {
    const bool ours = planner.plan == planning::planWithDollytrack;
    // Without room views, the paper's smoothing uses the same path as our planner.
    const bool same_path = planner.plan == planning::planPaperSmoothing &&
                           params.gaze.view_mix <= 0.0 &&
                           !planning::asksForTrackability(params.gaze, params.timing);
    if (!ours && !same_path) {
        const auto begin = std::chrono::steady_clock::now();
        return planner.plan(*mapped_, params, params.seed, job)
            .map([&](planning::PlannedMotion&& motion) {
                const std::chrono::duration<double, std::milli> spent =
                    std::chrono::steady_clock::now() - begin;
                if (!motion.plan_ms) motion.plan_ms = spent.count();
                return std::move(motion);
            });
    }
    if (!plan_) {
        auto plan = pipeline_->run(params, opened_->plan_edits, job);
        if (!plan) return tl::unexpected(std::move(plan.error()));
        plan_ = std::move(*plan);
    }
    if (!ours) return planning::smoothAsThePaper(*mapped_, *plan_, params);
    stages = plan_->stages;
    return planning::plannedMotionOf(*plan_);
}

Result<std::vector<SweepPoint>> Sweeper::at(const std::vector<std::string>& assignments,
                                            const std::vector<const planning::Planner*>& planners,
                                            const JobContext& job) {
    if (Status status = open(assignments, job.stage(0.0, 0.1, "loading")); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    planning::PlanParams params = opened_->params;
    const FieldList fields = planning::listFields(params);
    for (const std::string& assignment : assignments) {
        if (Status status = setField(fields, assignment); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    params.timing.max_frames = planning::frameBudget(params);
    std::vector<SweepPoint> points;
    if (Status status = map(params, job.stage(0.1, 0.2, "free space")); !status) {
        if (status.error().code == ErrorCode::Cancelled) {
            return tl::unexpected(std::move(status.error()));
        }
        for (const planning::Planner* one : planners) points.push_back(gapOf(*one, status.error()));
        return points;
    }
    plan_.reset();
    for (std::size_t i = 0; i < planners.size(); ++i) {
        const auto share = [&](double done) {
            return 0.2 +
                   0.8 * (static_cast<double>(i) + done) / static_cast<double>(planners.size());
        };
        SweepPoint point;
        point.planner = planners[i]->name;
        const auto motion = planMotion(*planners[i], params, point.stages,
                                       job.stage(share(0.0), share(0.5), point.planner));
        if (!motion && motion.error().code != ErrorCode::Cancelled) {
            points.push_back(gapOf(*planners[i], motion.error()));
            continue;
        }
        if (!motion) return tl::unexpected(motion.error());
        const auto measured = planning::measurePlannedMotion(
            *mapped_, *motion, job.stage(share(0.5), share(1.0), "metrics"));
        if (!measured) return tl::unexpected(measured.error());
        point.metrics = planning::toRow(*measured);
        points.push_back(std::move(point));
    }
    return points;
}

}  // namespace dollytrack::cli
