#pragma once

#include "engine/math/pose.h"

#include <string_view>
#include <vector>

namespace dollytrack {

/// Why a candidate position was not taken, or that it could be.
enum class Verdict {
    Legal,
    InObstacle,
    OutsideRoom,
    OccludedBy,
    TooClose,
    Cropped,
    TooSmall,
    NoGo,        // the camera's sphere would enter a no-go box
    HeightBand,  // lower or higher above the floor than the camera may be
    PitchBand,   // looks lower or higher than the camera may; pinned points only
    InGap,       // between surfaces that are close on both sides
    Unscanned,   // of a scan: most of the image shows nothing, or backs of surfaces
};

std::string_view name(Verdict verdict);

/// One place tried for an observation point. Kept so that a person can see why.
struct Candidate {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double fill = 0.0;              // share of the image's length in the tighter direction
    double visible_fraction = 0.0;  // of the worst object of the group
    Verdict verdict = Verdict::Legal;
    int occluder = 0;  // object id, with OccludedBy
};

/// An object that a view captures well, with a margin.
struct ShownObject {
    int object_id = 0;
    double box_share = 0.0;  // of the image
    bool operator==(const ShownObject&) const = default;
};

/// Where a key frame stands: P in the paper.
struct PositionPoint {
    int observation_point = 0;  // index
    Pose pose;                  // world_from_camera, roll 0, looks at the observation point
                                // unless it is pinned
    int component = 0;          // of free space
    double fill = 0.0;
    std::vector<int> well_captured;  // ids of every object this frame captures well
    std::vector<int> captured;       // ids of every object it captures, the above included
    std::vector<ShownObject> own;    // of well_captured, those estimated densely
    int pin = -1;                    // index in PlanEdits::pinned; -1: found by the search
    /// A key frame at this very pose, whatever it captures: pinned, or asked for.
    bool fixed = false;
    /// Shows many objects at once from farther away. A key frame as far as the budget of frames
    /// allows, whatever it captures.
    bool room_view = false;
    /// The view shows surface that no other view covers. It becomes a key frame as far as the
    /// budgets of frames and metres allow.
    bool surface_view = false;
    int room = 0;  // points of different rooms are on trajectories of their own
};

/// The outcome of the search for one observation point.
struct ViewpointSearch {
    std::vector<Candidate> candidates;
    int position_point = -1;  // index of the best, -1 when none was legal
    bool removed = false;     // by hand: it gets no position point
};

}  // namespace dollytrack
