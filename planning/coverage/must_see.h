#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/coverage/surface_patches.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <string>
#include <vector>

namespace dollytrack::planning {

/// Coverage of one must-see region: its surface patches, which of them can be seen, and chosen
/// views. A frame sees a patch if it is in the image and PatchVisibility reaches it. A patch is
/// seeable if one of 500 random legal camera positions near the region sees it with an allowed
/// pitch.
struct MustSee {
    std::string name;
    SurfacePatches surface;
    std::vector<char> seeable;  // by patch: 1 if seeable
    std::vector<int> kept;      // indices of the given views that must be kept for their coverage
    std::vector<Pose> views;    // additional views; up to 60, until 98 % of the seeable patches are
                                // covered
};

/// The must-see regions among `regions`, with their weight set to 1.
std::vector<Region> mustSeeAmong(const std::vector<Region>& regions);

/// A view that the trajectory already contains.
struct ExistingView {
    Pose pose;
    bool fixed = false;  // whether it stays even if no region needs it
};

/// Chooses views that cover each region, by greedy set cover: fixed given views count first, then
/// given views that each add at least 2 % of the seeable patches are kept, then new views are
/// added. Logs a warning for a region without surface. Error: Cancelled.
Result<std::vector<MustSee>> findMustSee(const PlanningEnvironment& environment,
                                         const std::vector<Region>& regions,
                                         std::vector<ExistingView> given, const JobContext& job);

/// Counts the patches of each region that frames of the trajectory see. A patch that a frame sees
/// counts as seeable. Error: Cancelled.
Result<std::vector<RegionCoverage>> measureCoverage(const std::vector<MustSee>& must_see,
                                                    const ViewEstimator& views,
                                                    const Trajectory& trajectory,
                                                    const JobContext& job);

}  // namespace dollytrack::planning
