#pragma once

#include "engine/core/random.h"
#include "planning/viewpoints/candidate_judge.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// The last resort for an object that is missed only just: looks by every pixel and without the
/// margins, first at the places given, then ever closer beside the best of them, where that misses
/// little. Returns a legal place that captures the object well.
std::optional<Eigen::Vector3d> climbToCapture(const Surroundings& around,
                                              const CandidateJudge& judge, int object_id,
                                              const std::vector<Eigen::Vector3d>& places,
                                              Random& random);

}  // namespace dollytrack::planning
