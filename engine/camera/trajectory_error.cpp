#include "engine/camera/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace dollytrack {
namespace {

Similarity align(const Trajectory& truth, const Trajectory& estimate,
                 const std::vector<std::pair<int, int>>& matches, Alignment alignment) {
    if (alignment == Alignment::None || matches.empty()) return {};
    std::vector<Eigen::Vector3d> from, onto;
    for (const auto& [i, k] : matches) {
        onto.push_back(truth.frames[i].pose.position);
        from.push_back(estimate.frames[k].pose.position);
    }
    return alignPoints(from, onto, alignment == Alignment::Similarity);
}

/// The transform from the second camera to the first, with lengths multiplied by `scale`.
Eigen::Isometry3d motionBetween(const Pose& first, const Pose& second, double scale) {
    Eigen::Isometry3d motion = first.worldFromCamera().inverse() * second.worldFromCamera();
    motion.translation() *= scale;
    return motion;
}

}  // namespace

int posesNeeded(Alignment alignment) {
    if (alignment == Alignment::None) return 1;
    return alignment == Alignment::Rigid ? 2 : 3;
}

ErrorFigures figuresOf(std::vector<double> errors) {
    ErrorFigures figures;
    figures.count = static_cast<int>(errors.size());
    if (errors.empty()) return figures;
    std::sort(errors.begin(), errors.end());
    const auto count = static_cast<double>(errors.size());
    const double squares = std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
    figures.rmse = std::sqrt(squares / count);
    figures.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
    const std::size_t half = errors.size() / 2;
    figures.median =
        errors.size() % 2 == 1 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
    figures.max = errors.back();
    return figures;
}

std::vector<std::pair<int, int>> matchByTime(const Trajectory& truth, const Trajectory& estimate,
                                             double max_dt_s) {
    struct Candidate {
        double apart_s;
        int truth, estimate;
    };
    std::vector<Candidate> candidates;
    std::size_t first = 0;
    for (std::size_t i = 0; i < truth.frames.size(); ++i) {
        const double time = truth.frames[i].time_s;
        while (first < estimate.frames.size() && estimate.frames[first].time_s < time - max_dt_s) {
            ++first;
        }
        for (std::size_t k = first;
             k < estimate.frames.size() && estimate.frames[k].time_s <= time + max_dt_s; ++k) {
            candidates.push_back({std::abs(estimate.frames[k].time_s - time), static_cast<int>(i),
                                  static_cast<int>(k)});
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.apart_s < b.apart_s; });
    std::vector<bool> truth_taken(truth.frames.size()), estimate_taken(estimate.frames.size());
    std::vector<std::pair<int, int>> matches;
    for (const Candidate& one : candidates) {
        const std::size_t i = one.truth;
        const std::size_t k = one.estimate;
        if (truth_taken[i] || estimate_taken[k]) continue;
        truth_taken[i] = estimate_taken[k] = true;
        matches.emplace_back(one.truth, one.estimate);
    }
    std::sort(matches.begin(), matches.end());
    return matches;
}

TrajectoryError trajectoryError(const Trajectory& truth, const Trajectory& estimate,
                                const TrajectoryErrorSettings& settings) {
    TrajectoryError error;
    error.frames = static_cast<int>(truth.frames.size());
    error.matches = matchByTime(truth, estimate, settings.max_dt_s);
    error.measured = static_cast<int>(error.matches.size()) >= posesNeeded(settings.alignment);
    if (!error.measured) return error;
    error.world_from_estimate = align(truth, estimate, error.matches, settings.alignment);
    const auto true_pose = [&](int i) -> const Pose& { return truth.frames[i].pose; };
    const auto estimated_pose = [&](int k) -> const Pose& { return estimate.frames[k].pose; };
    std::vector<double> distances, lengths, angles;
    for (const auto& [i, k] : error.matches) {
        distances.push_back(
            (error.world_from_estimate * estimated_pose(k).position - true_pose(i).position)
                .norm());
    }
    const std::map<int, int> estimate_of(error.matches.begin(), error.matches.end());
    for (const auto& [i, k] : error.matches) {
        const auto later = estimate_of.find(i + settings.delta);
        if (later == estimate_of.end()) continue;
        const auto& frames = truth.frames;
        if (frames[i].path != frames[later->first].path) {
            continue;
        }
        const Eigen::Isometry3d off =
            motionBetween(true_pose(i), true_pose(later->first), 1.0).inverse() *
            motionBetween(estimated_pose(k), estimated_pose(later->second),
                          error.world_from_estimate.scale);
        lengths.push_back(off.translation().norm());
        angles.push_back(
            Eigen::Quaterniond(off.linear()).angularDistance(Eigen::Quaterniond::Identity()));
    }
    error.absolute_m = figuresOf(std::move(distances));
    error.relative_m = figuresOf(std::move(lengths));
    error.relative_rad = figuresOf(std::move(angles));
    return error;
}

}  // namespace dollytrack
