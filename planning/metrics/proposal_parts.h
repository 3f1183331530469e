#pragma once

#include "planning/metrics/remedy_proposals.h"

#include <functional>
#include <string>
#include <vector>

// What the kinds of remedies share.
namespace dollytrack::planning {

inline constexpr std::size_t kLookedAt = 24;    // places a kind of remedy looks at again, exactly
inline constexpr std::size_t kMostOfAKind = 2;  // proposals of one kind
inline constexpr double kAlmost = 0.9;          // of what a coarse look must show for an exact one

/// How near a coarse look comes to what is asked for; 1: all of it.
double promise(const ViewEstimator::Estimate& seen, bool well);

/// Well before captured, then with as much in sight and in the image as is to be had.
double goodness(const ViewEstimator::Estimate& seen);

/// Places worth an exact look, by falling `order`.
std::vector<const WhatIfPlace*> bestFirst(const std::vector<WhatIfPlace>& places,
                                          const std::function<bool(const WhatIfPlace&)>& fits,
                                          const std::function<double(const WhatIfPlace&)>& order);

/// The view from a place that is aimed within the pitch band.
Pose poseAt(const WhatIf& what, const WhatIfPlace& place);

/// With nothing changed yet.
Proposal unchanged(const WhatIf& what, const std::optional<Pose>& view);

/// Gives a parameter another value, and says so.
void changeTo(Proposal& made, const std::string& name, double& field, double value);

/// Brings the near plane into the proposed camera's sphere; false where it would be nearer than
/// near_m can be.
[[nodiscard]] bool keepNearInSphere(Proposal& made);

}  // namespace dollytrack::planning
