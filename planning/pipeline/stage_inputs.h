#pragma once

#include "engine/document/edits.h"
#include "planning/plan_params.h"
#include "planning/visibility/pitch_band.h"

#include <vector>

namespace dollytrack::planning {

/// Version of the scene or of a stage's output: a number that grows whenever it changes.
using StageVersion = unsigned;

// Inputs of the stages of a pipeline, in their order. A stage computes its output again when one of
// these values differs from the last run's. `geometry`, `surfaces` and the like are versions of the
// output that the stage reads.

struct RayInputs {
    StageVersion geometry = 0;
    bool operator==(const RayInputs&) const = default;
};

struct SurfaceInputs {
    StageVersion geometry = 0;
    double resolution_m = 0.0;
    bool operator==(const SurfaceInputs&) const = default;
};

struct FreeSpaceInputs {
    StageVersion surfaces = 0;
    double camera_radius_m = 0.0;
    bool operator==(const FreeSpaceInputs&) const = default;
};

struct RegionInputs {
    StageVersion free_space = 0;
    std::vector<int> structure_classes;
    std::vector<NoGoBox> no_go;
    double min_height_m = 0.0;
    double max_height_m = 0.0;
    BodyParams body = {};
    bool operator==(const RegionInputs&) const = default;
};

struct ViewInputs {
    StageVersion scene = 0;
    CameraParams camera;
    bool operator==(const ViewInputs&) const = default;
};

struct TargetInputs {
    StageVersion views = 0;
    TargetParams targets;
    ViewpointParams viewpoints;
    bool operator==(const TargetInputs&) const = default;
};

struct ViewpointInputs {
    StageVersion targets = 0;
    StageVersion region = 0;
    StageVersion views = 0;
    ViewpointParams viewpoints;
    PitchBand pitch;
    int seed = 0;
    bool operator==(const ViewpointInputs&) const = default;
};

struct PlacedInputs {
    StageVersion found = 0;
    StageVersion views = 0;
    PitchBand pitch;
    std::vector<PinnedPoint> pinned;
    std::vector<RemovedPoint> removed;
    bool operator==(const PlacedInputs&) const = default;
};

struct RoomInputs {
    StageVersion free_space = 0;
    std::vector<int> structure_classes;
    bool operator==(const RoomInputs&) const = default;
};

/// Parameters that the constraints do not use keep their defaults, so that their changes have no
/// effect.
struct ConstraintInputs {
    StageVersion placed = 0;
    StageVersion rooms = 0;
    std::vector<Region> must_see;
    Anchors anchors = Anchors::None;
    RoomTours tours = RoomTours::Joined;
    double view_mix = 0.0;  // 0: no room views
    int max_frames = 0;
    int seed = 0;
    CoverageParams coverage = {};
    bool operator==(const ConstraintInputs&) const = default;
};

struct KeyFrameInputs {
    StageVersion points = 0;
    std::vector<double> object_weights;
    int visits = 0;
    int start = -1;
    int end = -1;
    bool loop = false;
    Objective objective = Objective::Objects;
    bool operator==(const KeyFrameInputs&) const = default;
};

struct RoadmapInputs {
    StageVersion key_frames = 0;
    RoadmapParams roadmap;
    int seed = 0;
    bool operator==(const RoadmapInputs&) const = default;
};

struct LinkingInputs {
    StageVersion roadmap = 0;
    LinkParams linking;
    int seed = 0;
    bool operator==(const LinkingInputs&) const = default;
};

/// Smoothing, timing and gaze only matter under a limit of length or of frames; without one they
/// keep their defaults.
struct PathInputs {
    StageVersion linking = 0;
    PathParams path;
    RoadmapParams roadmap;
    std::vector<double> object_weights;
    int start = -1;
    int end = -1;
    bool loop = false;
    int visits = 0;
    SmoothingParams smoothing = {};
    TimingParams timing = {};
    GazeParams gaze = {};
    BodyParams body = {};
    bool operator==(const PathInputs&) const = default;
};

struct SmoothingInputs {
    StageVersion paths = 0;
    SmoothingParams smoothing = {};
    BodyParams body = {};
    bool operator==(const SmoothingInputs&) const = default;
};

struct GazeInputs {
    StageVersion smoothing = 0;
    StageVersion views = 0;
    GazeParams gaze = {};
    TimingParams timing = {};
    bool operator==(const GazeInputs&) const = default;
};

struct TimingInputs {
    StageVersion gaze = 0;
    TimingParams timing = {};
    ShakeParams shake;
    BodyParams body = {};
    bool operator==(const TimingInputs&) const = default;
};

struct RepairInputs {
    StageVersion timing = 0;
    StageVersion views = 0;
    RepairParams repair;
    int seed = 0;
    bool operator==(const RepairInputs&) const = default;
};

/// The trajectory is the given motion, or goes through its keys; the timing only matters with keys,
/// otherwise it keeps its defaults. The other inputs affect its metrics.
struct MotionInputs {
    SharedMotion motion;
    TimingParams timing;
    StageVersion region = 0;
    StageVersion views = 0;
    StageVersion points = 0;
    bool trackability = false;
    bool operator==(const MotionInputs&) const = default;
};

struct MetricInputs {
    StageVersion trajectory = 0;
    RepairParams params;
    bool operator==(const MetricInputs&) const = default;
};

}  // namespace dollytrack::planning
