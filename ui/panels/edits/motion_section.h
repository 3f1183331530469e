#pragma once

#include "engine/document/given_motion.h"
#include "engine/plan/plan.h"
#include "ui/edit_request.h"

#include <span>
#include <string>

namespace dollytrack::ui {

/// Input of the section for one window frame.
struct MotionView {
    const GivenMotion* motion = nullptr;  // null: the camera path is planned
    const Plan* plan = nullptr;           // made with it; null: none yet
    std::string plan_error;               // why there is none; empty if planning has not failed
    bool has_scene = false;               // whether paths can be read and made
    bool has_object = false;              // whether one object is selected, for moves about it
    std::string change;                   // what the last repair changed; empty: none
    bool can_read_again = false;          // whether the path is from a file
    int world = 0;                        // its coordinate system, index in motionWorlds()
    bool busy = false;                    // a path is being read, repaired or made
    double fraction = 0.0;                // of that, 0..1
    std::string stage;
};

/// User actions of this frame.
struct MotionActions {
    EditRequest edit;
    bool import = false;  // ask for a file
    bool repair = false;
    bool cancel = false;
    int read_in_world = -1;  // read the file again, in this coordinate system; -1: no
    std::string make;        // kind of the move to make, about the selected object; empty: none
};

/// The coordinate systems of trajectory files; the first is the format's own, "".
std::span<const char* const> motionWorlds();

/// Draws the section on the given camera motion: import, repair, moves made from templates.
MotionActions drawMotionSection(const MotionView& view);

}  // namespace dollytrack::ui
