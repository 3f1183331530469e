#pragma once

#include "engine/camera/trajectory.h"
#include "engine/plan/repair_report.h"

#include <compare>
#include <cstddef>
#include <vector>

namespace dollytrack::planning {

/// A segment: the part of a path between two successive key frames, by the path's index and the
/// segment's number on it.
struct SegmentId {
    std::size_t path = 0;
    std::size_t number = 0;
    auto operator<=>(const SegmentId&) const = default;
};

/// Consecutive frames that score low, none of them a key frame.
struct LowRun {
    SegmentId segment;
    std::size_t first = 0;  // index in the trajectory
    std::size_t last = 0;   // inclusive
    [[nodiscard]] std::size_t size() const { return last - first + 1; }
};

/// The segment of each frame; a key frame belongs to the segment that ends there.
[[nodiscard]] std::vector<SegmentId> segmentsOf(const Trajectory& trajectory);

/// Runs of frames with scores below the threshold, each within one segment.
[[nodiscard]] std::vector<LowRun> lowRuns(const Trajectory& trajectory,
                                          const std::vector<double>& scores, double threshold);

/// The median of the scores, times `share`; 0 without scores.
[[nodiscard]] double lowThreshold(std::vector<double> scores, double share);

[[nodiscard]] ScoreTally tally(const std::vector<double>& scores, double threshold);

}  // namespace dollytrack::planning
