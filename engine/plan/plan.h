#pragma once

#include "engine/camera/trajectory.h"
#include "engine/plan/camera_path.h"
#include "engine/plan/capture.h"
#include "engine/plan/capture_ledger.h"
#include "engine/plan/frame_series.h"
#include "engine/plan/motion_metrics.h"
#include "engine/plan/passed_key.h"
#include "engine/plan/repair_report.h"
#include "engine/plan/roadmap.h"
#include "engine/plan/targets.h"
#include "engine/plan/viewpoint.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// A pinned point that planning could not keep, and the reason in words.
struct RefusedPin {
    int pin = -1;  // index in PlanEdits::pinned
    std::string name;
    Verdict verdict = Verdict::InObstacle;
    int object_id = 0;  // what is in the way; 0: none
    std::string reason;
};

struct StageTime {
    std::string name;
    double milliseconds = 0.0;
    bool reused = false;  // nothing it depends on had changed since the last run
};

/// Where the camera's centre comes nearest to a surface.
struct MinimumClearance {
    double clearance_m = 0.0;                            // from centre to surface
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of the camera's centre, world, m
    int object_id = 0;                                   // the surface's; 0: no trajectory
    int frame = 0;                                       // the nearest one
};

/// The metrics that are not about objects. Rates are 0..1.
struct TrajectoryMetrics {
    double path_length_m = 0.0;
    double repeat_rate = 0.0;    // frames of which < 1 % of the rays meet a 0.1 m patch of
                                 // surface that no earlier frame saw
    double object_pixels = 0.0;  // mean share of the image on targets
    double corner_collision_rate = 0.0;
    double frame_collision_rate = 0.0;
    /// Moves from one frame to the next that the camera makes around something, while the straight
    /// line between the two frames is not free.
    int straight_lines_that_hit = 0;
    MinimumClearance minimum_clearance;
    MotionMetrics motion;
    std::optional<double> trackable_rate;  // share of the frames with at least kTrackableCorners;
                                           // empty without trackability
};

/// What the frames show of the surface in a must-see region, in patches of about 0.1 m.
struct RegionCoverage {
    std::string name;
    int patches = 0;  // all of its surface
    int seeable = 0;  // from some place where the camera may be
    int seen = 0;     // by some frame
    /// Share of what can be seen, 0..1; 1 where nothing can, 0 without any surface.
    [[nodiscard]] double rate() const {
        if (patches == 0) return 0.0;
        return seeable > 0 ? static_cast<double>(seen) / seeable : 1.0;
    }
};

/// What the frames show of a patch of surface.
enum class PatchState {
    Unseen,
    Seen,        // some frame shows it, but not from the directions and at the resolution asked for
    SeenAtBest,  // seen from as many directions as the tried positions allow, fewer than asked for
    Covered,     // seen from the directions and at the resolution asked for
};

/// A patch of surface in the world frame, m, and what the frames show of it.
struct MeasuredPatch {
    Eigen::Vector3f point = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  // unit, towards the camera's positions
    PatchState state = PatchState::Unseen;
};

/// What the frames show of all surface that is visible from where the camera may be, in patches.
struct SurfaceShare {
    double patch_m = 0.0;  // edge of a patch
    int patches = 0;
    int seen = 0;       // patches that some frame shows
    int covered = 0;    // patches shown from the directions and at the resolution asked for
    int coverable = 0;  // patches that the tried positions can cover, or that frames cover
    std::vector<MeasuredPatch> measured;  // one per patch
    /// Share of the patches, 0..1; 0 without any.
    [[nodiscard]] double rateOf(int count) const {
        return patches > 0 ? static_cast<double>(count) / patches : 0.0;
    }
};

/// What joins or opens rooms and is visited for its own sake, of one kind.
struct AnchorTally {
    std::string kind;  // "doorways", "openings", "corridors", as the parameter has it
    int found = 0;     // in the scene
    int visited = 0;   // with a view of their own on the way; a corridor has two
};

/// A room that has a trajectory of its own, see CameraPath::room.
struct TourRoom {
    std::string name;         // a folder's name, too
    Eigen::AlignedBox3d box;  // of the camera's places in it
};

/// How many targets a dense search over all legal poses could capture.
struct CaptureBound {
    double capturable_rate = 0.0;
    double well_capturable_rate = 0.0;
    std::vector<int> not_capturable;       // object ids
    std::vector<int> not_well_capturable;  // object ids
};

/// Everything that planning found. Plain data, shared by export, project files and images.
struct Plan {
    std::vector<Eigen::AlignedBox3d> rooms;  // by component of free space
    std::optional<double> scanned_share;     // of the rooms' air, 0..1; scans only
    std::vector<ObservationPoint> observation_points;
    std::vector<ViewpointSearch> searches;  // one an observation point
    std::vector<PositionPoint> position_points;
    std::vector<int> key_frames;  // indices of the position points that are visited
    Roadmap roadmap;
    std::vector<CameraPath> paths;  // one a component of free space, largest room first
    std::vector<SmoothPath> smooth_paths;
    Trajectory trajectory;
    bool given_motion = false;           // the trajectory is PlanEdits::motion, not planned
    std::vector<PassedKey> passed_keys;  // one for each of its keys
    std::vector<TourRoom> tour_rooms;    // by number; empty: one trajectory for all

    std::vector<ObjectCapture> captures;  // estimated by rays
    CaptureMetrics capture_metrics;
    /// By frame, ordered by object id: the targets of which more than half is in the image.
    /// Coarse estimates, but exact for the frames that decide about an object.
    std::vector<std::vector<ObjectView>> frame_views;
    FrameSeries series;
    TrajectoryMetrics trajectory_metrics;
    RepairReport repair;
    std::vector<RegionCoverage> must_see;
    std::optional<SurfaceShare> surface;  // if the objective includes surface
    std::vector<AnchorTally> anchors;     // one a kind that is asked for
    std::vector<LedgerRow> ledger;        // one a target, ordered by id
    std::vector<RefusedPin> refused_pins;

    std::vector<StageTime> stages;
    double map_ms = 0.0;
    double plan_ms = 0.0;
};

}  // namespace dollytrack
