#pragma once

#include "planning/metrics/plan_trials.h"
#include "planning/metrics/what_if_places.h"

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// A change that ought to help, and from where it would.
struct Proposal {
    PlanChange change;
    Remedy remedy;             // without its pin; the text says the change alone
    std::optional<Pose> view;  // that should capture the object then; to be pinned where planning
                               // does not find it by itself
    bool needs_pin = false;
    int lost = 0;    // other objects that are captured without it, and not with it
    int gained = 0;  // and the other way round
};

/// What proposals are made from. Keeps references.
struct WhatIf {
    const Surroundings& around;
    const PlanParams& params;
    const PlanEdits& edits;
    const Subject& subject;
    const std::vector<WhatIfPlace>& places;
    int object_id = 0;
    bool well = false;  // captured well is asked for, not captured
};

/// Whether the view from a pose is what is asked for, by as many rays as captures are counted with.
bool showsEnough(const ViewEstimator& views, const Pose& pose, int object_id, bool well);

// Each for one kind of remedy, the mildest change first, checked by rays from the very place.
std::vector<Proposal> proposePins(const WhatIf& what);
std::vector<Proposal> proposePitches(const WhatIf& what);  // a looser pitch band
std::vector<Proposal> proposeRegions(const WhatIf& what);  // no-go boxes and the height band
std::vector<Proposal> proposeSmallerCameras(const WhatIf& what);
std::vector<Proposal> proposeLenses(const WhatIf& what);
// For what does not fit, and where none of the places shows enough of it: the search looks more
// closely at some, and may find a view through a wider lens. Nothing is checked.
std::vector<Proposal> proposeWiderUnseen(const WhatIf& what);
std::vector<Proposal> proposeMoves(const WhatIf& what, PlanTrials& trials);

}  // namespace dollytrack::planning
