#pragma once

#include "engine/math/pose.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// Where an object was lost on its way to a frame that captures it (well): in the order of the
/// method, the first stage that left nothing.
enum class Loss {
    NoFreePose,       // no place tried for it is free and allowed
    Occluded,         // something hides it at every free place
    TooSmall,         // seen, but too small in the image wherever the camera may be
    DoesNotFit,       // cropped wherever nothing hides it
    PitchBand,        // in sight, but only for a camera that looks lower or higher than it may
    OtherComponent,   // its view is in a part of free space that no path goes through
    DroppedByPath,    // its key frame is not on the path
    LostInSmoothing,  // the rounded path passes its key frame where it no longer shows
    DroppedByScore,   // on the path, but its frame was taken out
    ByHand,           // its position point was removed, or a pinned one stands in that misses it
    SearchMissed,     // a denser search found a view that the search had not
    NotInMotion,      // a view was found, but the given camera motion has none
    OverBudget,       // its key frame was dropped to keep to max_frames
};

std::string_view name(Loss loss);

/// A change that a search found to help, and tried.
struct Remedy {
    std::vector<std::string> settings;  // parameters, as `--set` takes them: "hfov_deg=38"
    std::optional<Pose> pin;            // a position point to place by hand, world_from_camera
    std::string remove_no_go;           // name of a no-go box to take away; empty: none
    std::vector<std::vector<int>> restore_points;  // removed by hand: what each stood for
    std::string unpin;                             // name of a pinned point to let go; empty: none
    int move_object = 0;                           // id of an object to put elsewhere; 0: none
    bool well = false;  // the object is then captured well, not only captured
    std::string text;   // all that as a sentence's part, for a person

    bool operator==(const Remedy&) const = default;
};

/// What became of one target.
struct LedgerRow {
    int object_id = 0;
    bool captured = false;
    bool well_captured = false;

    // The frame that decides: of those that capture it well the best, else the best of all.
    int frame = -1;  // in the trajectory; -1: it is never seen, and what follows is 0
    double time_s = 0.0;
    bool key_frame = false;
    double visible_fraction = 0.0;
    double box_share = 0.0;   // of the image
    double mask_share = 0.0;  // of the image
    double distance_m = 0.0;  // from the camera to the middle of the object's box

    // For what is not captured, or not well.
    std::optional<Loss> loss;
    int occluder = 0;    // object id, with Occluded
    std::string reason;  // a sentence
    std::optional<Remedy> remedy;
};

}  // namespace dollytrack
