#include "planning/repair/low_runs.h"

#include "engine/math/quantile.h"

#include <algorithm>
#include <numeric>

namespace dollytrack::planning {

std::vector<SegmentId> segmentsOf(const Trajectory& trajectory) {
    std::vector<SegmentId> segments(trajectory.frames.size());
    std::size_t keys = 0;  // key frames so far on this path
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const TrajectoryFrame& frame = trajectory.frames[i];
        if (!continuesPath(trajectory, i)) keys = 0;
        segments[i] = {static_cast<std::size_t>(frame.path), keys > 0 ? keys - 1 : 0};
        if (frame.position_point >= 0) ++keys;
    }
    return segments;
}

std::vector<LowRun> lowRuns(const Trajectory& trajectory, const std::vector<double>& scores,
                            double threshold) {
    const std::vector<SegmentId> segments = segmentsOf(trajectory);
    std::vector<LowRun> runs;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (scores[i] >= threshold || trajectory.frames[i].position_point >= 0) continue;
        const bool goes_on =
            !runs.empty() && runs.back().last + 1 == i && runs.back().segment == segments[i];
        if (goes_on) {
            runs.back().last = i;
        } else {
            runs.push_back({segments[i], i, i});
        }
    }
    return runs;
}

double lowThreshold(std::vector<double> scores, double share) {
    if (scores.empty()) return 0.0;
    return share * upperMedian(std::move(scores));
}

ScoreTally tally(const std::vector<double>& scores, double threshold) {
    ScoreTally result;
    result.frames = static_cast<int>(scores.size());
    if (scores.empty()) return result;
    result.low = static_cast<int>(
        std::count_if(scores.begin(), scores.end(), [&](double s) { return s < threshold; }));
    result.mean =
        std::accumulate(scores.begin(), scores.end(), 0.0) / static_cast<double>(scores.size());
    return result;
}

}  // namespace dollytrack::planning
