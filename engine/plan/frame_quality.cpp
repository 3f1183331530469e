#include "engine/plan/frame_quality.h"

#include "engine/math/quantile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace dollytrack {
namespace {

nlohmann::json orNull(const std::optional<double>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json();
}

int countUntrackable(const std::vector<double>& image_corners) {
    return static_cast<int>(std::ranges::count_if(image_corners, isUntrackable));
}

}  // namespace

std::optional<double> trackableRate(const std::vector<double>& image_corners) {
    if (image_corners.empty()) return std::nullopt;
    const auto frames = static_cast<double>(image_corners.size());
    return (frames - countUntrackable(image_corners)) / frames;
}

FrameQualitySummary summarize(const Trajectory& trajectory, const FrameQuality& quality) {
    FrameQualitySummary summary;
    summary.untrackable = countUntrackable(quality.image_corners);
    summary.trackable_rate = trackableRate(quality.image_corners);
    std::vector<double> overlaps;
    for (std::size_t i = 0; i < quality.overlap.size(); ++i) {
        if (continuesPath(trajectory, i)) overlaps.push_back(quality.overlap[i]);
    }
    if (overlaps.empty()) return summary;
    summary.wide_gaps = static_cast<int>(std::ranges::count_if(overlaps, isWideGap));
    summary.overlap_min_rate = std::ranges::min(overlaps);
    std::ranges::sort(overlaps);
    summary.overlap_median_rate = quantile(overlaps, 0.5);
    return summary;
}

void addSurface(nlohmann::json& metrics, const SurfaceShare& surface) {
    metrics["surface_seen_rate"] = surface.rateOf(surface.seen);
    metrics["surface_covered_rate"] = surface.rateOf(surface.covered);
    metrics["surface_coverable_rate"] = surface.rateOf(surface.coverable);
    metrics["surface_patches"] = surface.patches;
    metrics["surface_patch_m"] = surface.patch_m;
}

void addFrameQuality(nlohmann::json& metrics, const Trajectory& trajectory,
                     const FrameQuality& quality) {
    const FrameQualitySummary summary = summarize(trajectory, quality);
    metrics["untrackable_frames"] = summary.untrackable;
    metrics["trackable_rate"] = orNull(summary.trackable_rate);
    metrics["wide_gaps"] = summary.wide_gaps;
    metrics["overlap_median_rate"] = orNull(summary.overlap_median_rate);
    metrics["overlap_min_rate"] = orNull(summary.overlap_min_rate);
    addSurface(metrics, quality.surface);
}

std::string frameTable(const Trajectory& trajectory, const FrameSeries& series,
                       const FrameQuality& quality) {
    std::string text =
        "frame,time_s,path,key_frame,clearance_m,speed_mps,turn_dps,in_view,captured,"
        "well_captured,newly_captured,score,image_corners,overlap\n";
    for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
        const TrajectoryFrame& frame = trajectory.frames[i];
        fmt::format_to(std::back_inserter(text), "{},{:.9g},{},{},{:.6g},", i, frame.time_s,
                       frame.path, frame.position_point >= 0 ? 1 : 0, series.clearance_m[i]);
        if (continuesPath(trajectory, i)) {
            fmt::format_to(std::back_inserter(text), "{:.6g},{:.6g},", series.speed_mps[i],
                           series.turn_dps[i]);
        } else {
            text += ",,";
        }
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.6g},{:.6g},", series.in_view[i],
                       series.captured[i], series.well_captured[i], series.newly_captured[i].size(),
                       series.score[i], quality.image_corners[i]);
        text += continuesPath(trajectory, i) ? fmt::format("{:.6g}\n", quality.overlap[i]) : "\n";
    }
    return text;
}

}  // namespace dollytrack
