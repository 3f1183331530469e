#pragma once

#include "engine/core/random.h"
#include "planning/viewpoints/candidate_evaluator.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// Candidates whose ray-sampled EvaluatedCandidate::nearness is below this are never captured when
/// every pixel is tested.
constexpr double kPromisingNearness = 1.86;

struct ExactSearchResult {
    std::optional<Eigen::Vector3d> place;   // legal position that captures the object well, without
                                            // margins; empty if none was found
    std::vector<EvaluatedCandidate> tried;  // all candidates sampled, apart from the given ones
};

/// Last stage of the search, for an object that is missed only just: an evolutionary search with
/// ViewEstimator::estimateExactly() and isWellCaptured(), without margins. It starts with the first
/// 5 of `places` and samples ever closer to the best ones. At most about 1,400 exact estimates.
ExactSearchResult searchExactViewpoint(const PlanningEnvironment& environment,
                                       const CandidateEvaluator& evaluator, int object_id,
                                       const std::vector<Eigen::Vector3d>& places, Random& random);

}  // namespace dollytrack::planning
