#include "engine/plan/image_score.h"

namespace dollytrack {
namespace {

double overlap(const Eigen::AlignedBox2d& a, const Eigen::AlignedBox2d& b) {
    const Eigen::AlignedBox2d both = a.intersection(b);
    const double shared = both.isEmpty() ? 0.0 : both.sizes().prod();
    const double covered = a.sizes().prod() + b.sizes().prod() - shared;
    return covered > 0.0 ? shared / covered : 0.0;
}

double apart(const Eigen::AlignedBox2d& a, const Eigen::AlignedBox2d& b, bool squared) {
    const double diagonal = a.merged(b).diagonal().norm();
    if (diagonal <= 0.0) return 0.0;
    const double distance = (a.center() - b.center()).norm() / diagonal;
    return (squared ? distance * distance : distance) - overlap(a, b);
}

/// Mean of count_i / count_j over the frames j just before frame i.
double continuityAt(const Trajectory& trajectory,
                    const std::vector<std::vector<Eigen::AlignedBox2d>>& boxes, std::size_t i,
                    int window) {
    const auto count = static_cast<double>(boxes[i].size());
    double sum = 0.0;
    int compared = 0;
    for (std::size_t back = 1; back <= static_cast<std::size_t>(window) && back <= i; ++back) {
        if (trajectory.frames[i - back].path != trajectory.frames[i].path) break;
        const auto before = static_cast<double>(boxes[i - back].size());
        sum += before > 0.0 ? count / before : 1.0;
        ++compared;
    }
    return compared > 0 ? sum / compared : 1.0;
}

}  // namespace

double boxSeparation(const std::vector<Eigen::AlignedBox2d>& boxes, bool squared) {
    if (boxes.empty()) return 0.0;
    if (boxes.size() == 1) return 1.0;
    double sum = 0.0;
    for (std::size_t m = 0; m < boxes.size(); ++m) {
        for (std::size_t n = m + 1; n < boxes.size(); ++n) {
            sum += apart(boxes[m], boxes[n], squared);
        }
    }
    const auto count = static_cast<double>(boxes.size());
    return sum / (0.5 * count * (count - 1.0));
}

std::vector<double> imageScores(const Trajectory& trajectory,
                                const std::vector<std::vector<Eigen::AlignedBox2d>>& boxes,
                                const ScoreWeights& weights) {
    std::vector<double> scores(boxes.size(), 0.0);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (boxes[i].empty()) continue;
        scores[i] = weights.separation * boxSeparation(boxes[i], weights.squared) +
                    weights.continuity * continuityAt(trajectory, boxes, i, weights.window);
    }
    return scores;
}

}  // namespace dollytrack
