#pragma once

#include "planning/remedies/remedy_proposals.h"

#include <functional>
#include <string>
#include <vector>

// Shared parts of all kinds of remedies.
namespace dollytrack::planning {

inline constexpr std::size_t kLookedAt = 24;    // most candidates that a kind of remedy estimates
                                                // exactly
inline constexpr std::size_t kMostOfAKind = 2;  // most proposals of one kind
inline constexpr double kAlmost = 0.9;          // share of the requirement that a coarse estimate
                                                // must reach before an exact one is made

/// How close a coarse estimate comes to the requirement; 1: it meets it.
double promise(const ViewEstimator::Estimate& seen, bool well);

/// Order of views: captured well counts most, then captured, then visible fraction and size.
double goodness(const ViewEstimator::Estimate& seen);

/// The positions that satisfy `fits`, sorted by descending `order`.
std::vector<const HypotheticalPosition*> bestFirst(
    const std::vector<HypotheticalPosition>& places,
    const std::function<bool(const HypotheticalPosition&)>& fits,
    const std::function<double(const HypotheticalPosition&)>& order);

/// The view of the object from a position, within the pitch band.
Pose poseAt(const ProposalContext& context, const HypotheticalPosition& place);

/// A proposal without any change yet.
Proposal unchanged(const ProposalContext& context, const std::optional<Pose>& view);

/// Changes a parameter, and adds that to the remedy's settings and text.
void changeTo(Proposal& made, const std::string& name, double& field, double value);

/// Lowers near_m until the near plane fits in the proposed camera's sphere. Returns false if it
/// would have to be below the least near_m.
[[nodiscard]] bool keepNearInSphere(Proposal& made);

}  // namespace dollytrack::planning
