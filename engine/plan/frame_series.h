#pragma once

#include "engine/camera/trajectory.h"
#include "engine/plan/capture.h"

#include <vector>

namespace dollytrack {

class RayCaster;

/// Smallest estimated number of image corners of a trackable frame; ORB usually finds at least 100
/// there.
inline constexpr double kTrackableCorners = 150.0;

/// Measurements of each frame of a trajectory, for timelines and colours. One entry per frame.
struct FrameSeries {
    std::vector<double> clearance_m;   // from the camera's centre to the nearest surface, exact
    std::vector<double> speed_mps;     // on the way from the frame before; 0 where a path begins
    std::vector<double> turn_dps;      // likewise
    std::vector<double> score;         // see imageScores()
    std::vector<int> in_view;          // targets of which more than half is in the image, in sight
    std::vector<int> captured;         // of them, captured by this frame
    std::vector<int> well_captured;    // of them, captured well
    std::vector<int> captured_so_far;  // targets captured by this frame or an earlier one
    std::vector<std::vector<int>> newly_captured;  // ids of those captured for the first time
    /// Estimated number of corners that a feature detector finds in the image, scaled to a width
    /// of 320 pixels; at most 1.5 times those that the image five frames earlier shows too. Empty
    /// without trackability.
    std::vector<double> image_corners;

    [[nodiscard]] std::size_t size() const { return clearance_m.size(); }
};

/// Distance to the nearest surface, exact, m.
[[nodiscard]] double clearanceAt(const RayCaster& rays, const Eigen::Vector3d& position);

/// `views` has one list a frame; `captures` is the final word on what is captured at all, since
/// some views are estimated coarsely. `scores` has one a frame.
[[nodiscard]] FrameSeries measureFrames(const Trajectory& trajectory,
                                        const std::vector<std::vector<ObjectView>>& views,
                                        const std::vector<ObjectCapture>& captures,
                                        std::vector<double> scores, const RayCaster& rays);

}  // namespace dollytrack
