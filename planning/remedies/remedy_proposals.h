#pragma once

#include "planning/remedies/hypothetical_positions.h"
#include "planning/remedies/plan_trials.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// A change that should help an object, and the view it would give.
struct Proposal {
    PlanChange change;
    Remedy remedy;             // without its pin; the text describes the change only
    std::optional<Pose> view;  // view that should then capture the object; pinned if planning does
                               // not find it by itself
    bool needs_pin = false;
    int lost = 0;    // other objects captured without it, but not with it
    int gained = 0;  // other objects captured with it, but not without it
};

/// Input of the proposals. Keeps references.
struct ProposalContext {
    const PlanningEnvironment& environment;
    const PlanParams& params;
    const PlanEdits& edits;
    const Subject& subject;
    const std::vector<HypotheticalPosition>& places;
    int object_id = 0;
    bool well = false;  // whether it must be captured well, not only captured
};

/// Whether the view from a pose meets the requirement, by exact estimate.
bool showsEnough(const ViewEstimator& views, const Pose& pose, int object_id, bool well);

// Each proposes one kind of remedy, the mildest change first, verified by exact estimates from the
// proposed pose.
std::vector<Proposal> proposePins(const ProposalContext& context);
std::vector<Proposal> proposePitches(const ProposalContext& context);  // looser pitch band
std::vector<Proposal> proposeRegions(
    const ProposalContext& context);  // no-go boxes and height band
std::vector<Proposal> proposeSmallerCameras(const ProposalContext& context);
std::vector<Proposal> proposeLenses(const ProposalContext& context);
// Wider lenses for an object that does not fit, if no position shows enough of it. Not verified by
// estimates: the search itself samples more closely and may find a view.
std::vector<Proposal> proposeWiderUnseen(const ProposalContext& context);
std::vector<Proposal> proposeMoves(const ProposalContext& context, PlanTrials& trials);

}  // namespace dollytrack::planning
