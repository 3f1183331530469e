#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/collision/mapped_scene.h"
#include "planning/plan_params.h"

#include <vector>

namespace dollytrack::planning {

/// What a repair changed. Frames and moves are those of the given trajectory; a move is the
/// straight line between two successive frames of one path.
struct MotionChange {
    int frames_in_collision = 0;   // the camera overlaps a surface, or is outside free space or the
                                   // allowed region
    int moves_in_collision = 0;    // the same on the way between two frames
    int moves_over_limits = 0;     // faster or turning faster than the motion limits allow
    int frames_moved = 0;          // frames with another position
    int paths_cut = 0;             // cuts where no collision-free path exists; each adds a path
    double given_length_m = 0.0;   // of the paths
    double length_m = 0.0;         // the same, repaired
    double mean_shift_m = 0.0;     // of positions, over all frames
    double largest_shift_m = 0.0;  // of positions
    double mean_turn_rad = 0.0;    // of orientations, over all frames
    double largest_turn_rad = 0.0;  // of orientations
    double time_added_s = 0.0;      // over all paths
};

struct RepairedMotion {
    Trajectory trajectory;
    MotionChange change;
    // By frame: the given frame that it stands for, with a fraction between two given frames.
    std::vector<double> given_frames = {};
};

/// The nearest trajectory that is collision-free and within the motion limits (motionLimits();
/// limits of the heading do not apply). A free trajectory within the limits is returned unchanged,
/// and so is every part of one. Frames and the straight moves between them are free for the camera
/// sphere, and in the allowed region. Orientations are kept; only where a stretch needs more time
/// are they interpolated. The accelerations of unchanged parts are those given. The result does not
/// depend on the number of threads. Errors: BadInput if the trajectory has no frames, or a path of
/// it is nowhere near free space; Cancelled.
Result<RepairedMotion> repairMotion(const MappedScene& scene, const PlanParams& params,
                                    const Trajectory& given, const JobContext& job);

struct PathTiming;

/// What is done with a path that is nowhere near free space.
enum class FarPath { Refuse, Keep };

/// The same with this timing instead of one found from parameters and trajectory. Errors: also
/// BadInput if the result would have more than kMostMotionFrames.
Result<RepairedMotion> repairAndTime(const MappedScene& scene, const PathTiming& timing,
                                     const Trajectory& given, const JobContext& job,
                                     FarPath far_path = FarPath::Refuse);

}  // namespace dollytrack::planning
