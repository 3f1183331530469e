#include "app/cli/compare/evaluation.h"

#include "app/cli/terminal/terminal_text.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "engine/io/trajectories/trajectory_file.h"
#include "render/verify/read/number_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <numbers>

namespace dollytrack::cli {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
constexpr std::size_t kNameWidth = 24;

nlohmann::json toJson(const ErrorFigures& figures, double factor) {
    if (figures.count == 0) {  // null rather than 0, the best value
        return {{"rmse", nullptr},
                {"mean", nullptr},
                {"median", nullptr},
                {"max", nullptr},
                {"count", 0}};
    }
    return {{"rmse", factor * figures.rmse},
            {"mean", factor * figures.mean},
            {"median", factor * figures.median},
            {"max", factor * figures.max},
            {"count", figures.count}};
}

nlohmann::json toJson(const Similarity& alignment) {
    nlohmann::json rows = nlohmann::json::array();
    for (Eigen::Index row = 0; row < 3; ++row) {
        const Eigen::RowVector3d r = alignment.scale * alignment.rotation.row(row);
        rows.push_back({r.x(), r.y(), r.z(), alignment.translation[row]});
    }
    return {{"scale", alignment.scale}, {"world_from_estimate", std::move(rows)}};
}

nlohmann::json toJson(const RunFigures& run) {
    nlohmann::json one = {{"estimated", run.name},
                          {"success", run.success},
                          {"frames", run.error.frames},
                          {"tracked", run.error.matches.size()},
                          {"tracked_share", run.error.trackedShare()},
                          {"alignment", run.error.measured ? toJson(run.error.world_from_estimate)
                                                           : nlohmann::json()},
                          {"ate_m", toJson(run.error.absolute_m, 1.0)},
                          {"rpe_m", toJson(run.error.relative_m, 1.0)},
                          {"rpe_deg", toJson(run.error.relative_rad, kDegreesPerRadian)}};
    if (!run.not_measured.empty()) one["reason"] = run.not_measured;
    if (run.reconstruction) {
        one["reconstruction"] = {{"cloud", run.cloud},
                                 {"points", run.reconstruction->points},
                                 {"mean_m", run.reconstruction->mean_m},
                                 {"median_m", run.reconstruction->median_m},
                                 {"p90_m", run.reconstruction->p90_m}};
        if (run.completeness) one["reconstruction"]["completeness_5cm"] = *run.completeness;
    }
    return one;
}

/// A number in a table cell of fixed width; '-' if it is unknown.
std::string cell(double value, bool known, int decimals) {
    constexpr std::size_t kWidth = 9;
    std::string text = known ? fmt::format("{:.{}f}", value, decimals) : "-";
    if (text.size() > kWidth) text = fmt::format("{:.2e}", value);
    return fmt::format(" {:>{}}", text, kWidth);
}

std::string row(const RunFigures& run) {
    const TrajectoryError& error = run.error;
    const ErrorFigures& ate = error.absolute_m;
    std::string text = fmt::format("  {}", inColumn(run.name, kNameWidth));
    text += cell(100.0 * error.trackedShare(), true, 1);
    text += cell(error.world_from_estimate.scale, error.measured, 4);
    for (const double value : {ate.rmse, ate.mean, ate.median, ate.max}) {
        text += cell(1e3 * value, ate.count > 0, 1);
    }
    text += cell(1e3 * error.relative_m.rmse, error.relative_m.count > 0, 2);
    text += cell(kDegreesPerRadian * error.relative_rad.rmse, error.relative_rad.count > 0, 3);
    return text + (run.success ? "  success\n" : "  FAILED\n");
}

bool holdsNoPose(const std::string& text) {
    const auto lines = splitLines(text);
    return std::all_of(lines.begin(), lines.end(), [](std::string_view line) {
        const auto words = splitWords(line);
        return words.empty() || words.front().front() == '#';
    });
}

}  // namespace

Trajectory trueTrajectory(const verify::StoredDataset& dataset) {
    Trajectory trajectory;
    const auto rows = verify::NumberTable::read(dataset.folder / "frames.csv");
    const bool told = rows && rows->has("path") && rows->rows() == dataset.frames.size();
    for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
        TrajectoryFrame frame;
        frame.time_s = dataset.frames[i].time_s;
        frame.pose = dataset.frames[i].pose;
        if (told) frame.path = static_cast<int>(rows->number(i, "path").value_or(0.0));
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

Result<Trajectory> readEstimate(const std::string& path) {
    Result<std::string> text = readText(path);
    if (!text) return tl::unexpected(std::move(text.error()));
    if (holdsNoPose(*text)) return Trajectory{};
    TrajectoryReading reading;
    reading.world = "z-up";  // not converted: aligned later, or in the right world
    reading.has_options = false;
    Result<LoadedTrajectory> loaded = loadTrajectory(path, reading);
    if (!loaded) return tl::unexpected(std::move(loaded.error()));
    if (!loaded->timed) {
        return fail(ErrorCode::BadInput,
                    "Its poses have no times, so they cannot be assigned to frames; use the TUM "
                    "format, whose lines start with times.",
                    path);
    }
    return std::move(loaded->trajectory);
}

std::string whyNotMeasured(const Trajectory& truth, const Trajectory& estimate,
                           const TrajectoryError& error, const TrajectoryErrorSettings& settings) {
    if (error.measured) return {};
    if (estimate.frames.empty()) return "it contains no pose";
    if (truth.frames.empty()) return "the dataset has no frames";
    if (!error.matches.empty()) {
        return fmt::format("only {} of its poses {} to a frame; an alignment needs at least {}",
                           error.matches.size(), error.matches.size() == 1 ? "belongs" : "belong",
                           posesNeeded(settings.alignment));
    }
    const double from = truth.frames.front().time_s;
    const double to = truth.frames.back().time_s;
    const double first = estimate.frames.front().time_s;
    const double last = estimate.frames.back().time_s;
    const std::string times =
        fmt::format("the dataset lasts from {:.2f} to {:.2f} s, the file from {:.2f} to {:.2f} s",
                    from, to, first, last);
    if (first > to + settings.max_dt_s || last < from - settings.max_dt_s) {
        return "no time in common: " + times;
    }
    return fmt::format("no pose within {:g} s of a frame (--max-dt): {}", settings.max_dt_s, times);
}

bool isSuccess(const TrajectoryError& error, const SuccessLimits& limits) {
    return error.measured && error.trackedShare() >= limits.min_tracked &&
           error.absolute_m.rmse <= limits.max_ate_m;
}

double successRate(const std::vector<RunFigures>& runs) {
    const auto successes =
        std::count_if(runs.begin(), runs.end(), [](const RunFigures& run) { return run.success; });
    return runs.empty() ? 0.0 : static_cast<double>(successes) / static_cast<double>(runs.size());
}

nlohmann::json evaluationJson(const std::vector<RunFigures>& runs, const SuccessLimits& limits) {
    nlohmann::json list = nlohmann::json::array();
    for (const RunFigures& run : runs) list.push_back(toJson(run));
    return {{"runs", std::move(list)},
            {"success_rate", successRate(runs)},
            {"limits", {{"min_tracked", limits.min_tracked}, {"max_ate_m", limits.max_ate_m}}}};
}

std::string evaluationText(const std::vector<RunFigures>& runs, const SuccessLimits& limits,
                           const TrajectoryErrorSettings& settings) {
    std::string text;
    const auto out = std::back_inserter(text);
    const std::string no_name = inColumn("", kNameWidth);
    fmt::format_to(out, "  {} {:>9} {:>9} {:>39} {:>19}\n", no_name, "tracked", "scale",
                   "absolute error, mm", "relative, RMSE");
    fmt::format_to(out, "  {}", inColumn("run", kNameWidth));
    for (const char* head : {"%", "", "RMSE", "mean", "median", "max", "mm", "deg"}) {
        fmt::format_to(out, " {:>9}", head);
    }
    text += "\n";
    for (const RunFigures& run : runs) text += row(run);
    for (const RunFigures& run : runs) {
        if (run.not_measured.empty()) continue;
        fmt::format_to(out, "\nno errors for {}: {}", run.name, run.not_measured);
    }
    text += "\n";
    fmt::format_to(out, "relative errors are measured over {} frame{}\n", settings.delta,
                   settings.delta == 1 ? "" : "s");
    for (const RunFigures& run : runs) {
        if (!run.reconstruction) continue;
        const CloudError& cloud = *run.reconstruction;
        fmt::format_to(out,
                       "reconstruction {}: {} points, {:.1f} mm from the surfaces in the mean, "
                       "{:.1f} in the median, 90 % within {:.1f}",
                       run.cloud, cloud.points, 1e3 * cloud.mean_m, 1e3 * cloud.median_m,
                       1e3 * cloud.p90_m);
        if (run.completeness) {
            fmt::format_to(out, "; {:.1f} % of the surface in the frames has a point within 5 cm",
                           100.0 * *run.completeness);
        }
        text += "\n";
    }
    fmt::format_to(out,
                   "success rate {:.1f} %: runs that track {:g} % of the frames or more "
                   "(--min-tracked) with an RMSE of {:g} m or less (--max-ate)\n",
                   100.0 * successRate(runs), 100.0 * limits.min_tracked, limits.max_ate_m);
    if (successRate(runs) == 0.0) {
        text += "no run succeeded; that is a result, so the exit code is 0\n";
    }
    return text;
}

}  // namespace dollytrack::cli
