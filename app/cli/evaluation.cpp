#include "app/cli/evaluation.h"

#include "app/cli/terminal_text.h"
#include "engine/io/trajectories/number_lines.h"
#include "engine/io/trajectories/trajectory_file.h"
#include "render/verify/number_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <numbers>

namespace dollytrack::cli {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::size_t kNameWidth = 24;

nlohmann::json toJson(const ErrorFigures& figures, double factor) {
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
                          {"alignment", toJson(run.error.world_from_estimate)},
                          {"ate_m", toJson(run.error.absolute_m, 1.0)},
                          {"rpe_m", toJson(run.error.relative_m, 1.0)},
                          {"rpe_deg", toJson(run.error.relative_rad, kDegrees)}};
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

bool holdsNoPose(const std::string& text) {
    const auto lines = io::splitLines(text);
    return std::all_of(lines.begin(), lines.end(), [](std::string_view line) {
        const auto words = io::splitWords(line);
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
    Result<std::string> text = io::readText(path);
    if (!text) return tl::unexpected<Error>(std::move(text.error()));
    if (holdsNoPose(*text)) return Trajectory{};
    io::TrajectoryReading reading;
    reading.world = "z-up";  // as it is: it is aligned anyway, or has to be in our world
    reading.has_options = false;
    Result<io::LoadedTrajectory> loaded = io::loadTrajectory(path, reading);
    if (!loaded) return tl::unexpected<Error>(std::move(loaded.error()));
    if (!loaded->timed) {
        return fail(ErrorCode::BadInput,
                    "Its poses have no times, so nothing says of which frames they are; TUM's "
                    "lines begin with them.",
                    path);
    }
    return std::move(loaded->trajectory);
}

bool isSuccess(const TrajectoryError& error, const SuccessLimits& limits) {
    return !error.matches.empty() && error.trackedShare() >= limits.min_tracked &&
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
    fmt::format_to(out, "  {} {:>8} {:>7} {:>32} {:>20}\n", inColumn("", kNameWidth), "tracked",
                   "scale", "absolute error, mm", "relative, RMSE");
    fmt::format_to(out, "  {} {:>8} {:>7} {:>8}{:>8}{:>8}{:>8} {:>10}{:>10}\n",
                   inColumn("run", kNameWidth), "%", "", "RMSE", "mean", "median", "max", "mm",
                   "deg");
    for (const RunFigures& run : runs) {
        const ErrorFigures& ate = run.error.absolute_m;
        fmt::format_to(out,
                       "  {} {:>8.1f} {:>7.4f} {:>8.1f}{:>8.1f}{:>8.1f}{:>8.1f} {:>10.2f}{:>10.3f}"
                       "  {}\n",
                       inColumn(run.name, kNameWidth), 100.0 * run.error.trackedShare(),
                       run.error.world_from_estimate.scale, 1e3 * ate.rmse, 1e3 * ate.mean,
                       1e3 * ate.median, 1e3 * ate.max, 1e3 * run.error.relative_m.rmse,
                       kDegrees * run.error.relative_rad.rmse, run.success ? "success" : "FAILED");
    }
    fmt::format_to(out, "\nrelative errors are of motions over {} frame{}\n", settings.delta,
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
            fmt::format_to(out, "; {:.1f} % of what the frames show has a point within 5 cm",
                           100.0 * *run.completeness);
        }
        text += "\n";
    }
    fmt::format_to(out,
                   "success rate {:.1f} %: runs that track {:g} % of the frames or more "
                   "(--min-tracked) with an RMSE of {:g} m or less (--max-ate)\n",
                   100.0 * successRate(runs), 100.0 * limits.min_tracked, limits.max_ate_m);
    return text;
}

}  // namespace dollytrack::cli
