#pragma once

#include "engine/camera/trajectory.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack {

/// What the image score weighs (paper, 3.2.4).
struct ScoreWeights {
    double separation = 1.0;  // lambda
    double continuity = 1.0;  // mu
    int window = 5;           // s: frames before, that a frame is compared with
    bool squared = false;     // squares distance over diagonal, as the D-IoU it is taken from does
    bool operator==(const ScoreWeights&) const = default;
};

/// How far the objects of an image stand apart: the mean over all pairs of their boxes of
/// d / c - IoU, with the distance d of the boxes' centres and the diagonal c of the box around
/// both. 1 for a single box, 0 for none.
[[nodiscard]] double boxSeparation(const std::vector<Eigen::AlignedBox2d>& boxes, bool squared);

/// The paper's image score of each frame, from the boxes (px) of the objects it shows:
/// separation * boxSeparation + continuity * the mean of count_i / count_j over up to `window`
/// frames j before it on its path. A frame that shows nothing scores 0; the ratio to a frame that
/// shows nothing is 1, and so is the first frame's.
[[nodiscard]] std::vector<double> imageScores(
    const Trajectory& trajectory, const std::vector<std::vector<Eigen::AlignedBox2d>>& boxes,
    const ScoreWeights& weights = {});

}  // namespace dollytrack
