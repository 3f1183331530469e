#pragma once

#include "engine/core/random.h"
#include "planning/viewpoints/candidate_judge.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// Of Judged::nearness: with less by fewer rays, every pixel says no more.
constexpr double kMayBeThere = 1.86;

struct Climbed {
    std::optional<Eigen::Vector3d> place;  // legal, and captures the object well by every pixel
    std::vector<Judged> tried;             // all places looked from, but for those given
};

/// The last resort for an object that is missed only just: looks by every pixel and without the
/// margins (ViewEstimator::estimateExactly(), isWellCaptured()), first at the places given, then
/// ever closer beside the best of them, where that misses little. At most some 1,400 looks.
Climbed climbToCapture(const Surroundings& around, const CandidateJudge& judge, int object_id,
                       const std::vector<Eigen::Vector3d>& places, Random& random);

}  // namespace dollytrack::planning
