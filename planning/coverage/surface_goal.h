#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/coverage/surface_patches.h"

#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// The surface visible from positions where the camera fits, and what the views of it must fulfil.
/// A view shows a patch if the patch is in the image, nothing is in between, and the line of sight
/// is within 75 degrees of the normal. It shows the patch sharply if it is also near enough.
struct SurfaceGoal {
    SurfacePatches surface;  // one-sided: normals face the camera's positions
    double sharp_m = 0.0;    // farthest distance of a sharp view, m
    int directions = 3;      // from which each patch shall be seen sharply
    /// By patch: in how many directions it can be seen sharply from the positions that were tried,
    /// at most `directions`.
    std::vector<int> coverable;
};

/// Cosine of 75 degrees.
inline constexpr double kFlattestSurfaceCosine = 0.25881904510252074;

inline VisibilityRules surfaceRules() {
    return {.flattest_cosine = kFlattestSurfaceCosine, .two_sided = false};
}

/// Counts the patches that the frames of the trajectory see, and that they cover: sharply, from as
/// many directions as asked for, counted in the order of the frames (see DistinctDirections). A
/// patch that the frames cover is also counted as coverable. Error: Cancelled.
Result<SurfaceShare> measureSurface(const SurfaceGoal& goal, const ViewEstimator& views,
                                    const Trajectory& trajectory, const JobContext& job);

}  // namespace dollytrack::planning
