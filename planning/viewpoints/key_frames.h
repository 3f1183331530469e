#pragma once

#include "engine/plan/viewpoint.h"

#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// CaptureGet of the paper's Algorithm 1: completes the lists of objects that each position point
/// captures and captures well, its own and every other. Another point's object counts only while
/// it shows nearly as large as in its own best view, so that sharing never trades fill away.
void findCaptured(const ViewEstimator& views, std::vector<PositionPoint>& position_points);

/// A small choice of position points that together capture all that all of them capture (greedy
/// set cover; well captured counts first), in order of what each adds. Pinned ones come first, all
/// of them.
std::vector<int> chooseKeyFrames(const std::vector<PositionPoint>& position_points);

}  // namespace dollytrack::planning
