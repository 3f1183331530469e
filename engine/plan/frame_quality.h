#pragma once

#include "engine/plan/frame_series.h"
#include "engine/plan/plan.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// Smallest share of its image that a frame should have in common with the frame before it.
/// Photogrammetry flies with 60 to 80 % of forward overlap; programs that reconstruct scenes or
/// track the camera match few points below that.
inline constexpr double kLeastOverlap = 0.6;

/// How well programs that reconstruct scenes or track cameras can use the frames of a plan.
/// Estimated by rays, for plans of any objective.
struct FrameQuality {
    std::vector<double> image_corners;  // by frame, see FrameSeries::image_corners
    /// By frame, the share of the image whose surface the frame before shows too, 0..1; 1 where a
    /// path begins.
    std::vector<double> overlap;
    SurfaceShare surface;  // what the frames show of all surface
};

/// Whether a frame has fewer image corners than SLAM programs need (kTrackableCorners).
[[nodiscard]] inline bool isUntrackable(double image_corners) {
    return image_corners < kTrackableCorners;
}

/// Share of the frames that are trackable, 0..1; empty without frames.
[[nodiscard]] std::optional<double> trackableRate(const std::vector<double>& image_corners);

/// Whether a frame has too little of its image in common with the frame before it.
[[nodiscard]] inline bool isWideGap(double overlap) {
    return overlap < kLeastOverlap;
}

/// Numbers of a FrameQuality. Rates are 0..1; empty if there are no frames, or no frame follows
/// another.
struct FrameQualitySummary {
    int untrackable = 0;  // frames
    std::optional<double> trackable_rate;
    int wide_gaps = 0;  // between consecutive frames
    std::optional<double> overlap_median_rate;
    std::optional<double> overlap_min_rate;
};

[[nodiscard]] FrameQualitySummary summarize(const Trajectory& trajectory,
                                            const FrameQuality& quality);

/// Adds the shares of the surface that frames show, and cover, to the metrics.
void addSurface(nlohmann::json& metrics, const SurfaceShare& surface);

/// Adds the summary and the shares of surface to metrics (see metricsJson()) under their published
/// names; values that do not exist are null.
void addFrameQuality(nlohmann::json& metrics, const Trajectory& trajectory,
                     const FrameQuality& quality);

/// Measurements of each frame as CSV with a header. A column that also exists in a dataset's
/// frames.csv has the same name and unit. Speed and turn rate are empty where a path begins and
/// after left-out frames, overlap only where a path begins. `series` and `quality` must have an
/// entry for each frame.
[[nodiscard]] std::string frameTable(const Trajectory& trajectory, const FrameSeries& series,
                                     const FrameQuality& quality);

}  // namespace dollytrack
