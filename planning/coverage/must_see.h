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

/// What a must-see region asks for: its surface in patches, and which of them can be seen at all.
/// A patch is seen by a frame when it is in the image and PatchSight reaches it; it can be seen
/// when a place of the camera exists from where some allowed orientation shows it. Places are those
/// of the rooms' free cells near the region, drawn at random, so what can be seen is found from
/// these; what a frame shows beyond that counts as well.
struct MustSee {
    std::string name;
    SurfacePatches surface;
    std::vector<char> seeable;  // by patch
    std::vector<int> kept;      // of the given views: what they show is counted on
    std::vector<Pose> views;    // with these, at least 98 % of what can be seen is shown
};

/// The regions that must be seen, with weights of 1, which do not matter to that.
std::vector<Region> mustSeeAmong(const std::vector<Region>& regions);

/// A view that the trajectory has anyway.
struct GivenView {
    Pose pose;
    bool fixed = false;  // it stays as it is whether or not it is kept
};

/// Looks at every region and chooses views for it, each showing as much as one view can of what
/// those before it do not show: of the given ones those that show a good part of it, then new ones.
/// Error: Cancelled.
Result<std::vector<MustSee>> findMustSee(const Surroundings& around,
                                         const std::vector<Region>& regions,
                                         std::vector<GivenView> given, const JobContext& job);

/// What the frames of a trajectory show of the regions. Error: Cancelled.
Result<std::vector<RegionCoverage>> measureCoverage(const std::vector<MustSee>& must_see,
                                                    const ViewEstimator& views,
                                                    const Trajectory& trajectory,
                                                    const JobContext& job);

}  // namespace dollytrack::planning
