#pragma once

#include "engine/document/given_motion.h"
#include "engine/plan/plan.h"
#include "ui/edit_request.h"

#include <span>
#include <string>

namespace dollytrack::ui {

/// Input of the section for one window frame.
struct MotionView {
    const GivenMotion* motion = nullptr;  // null: the planner plans the camera's motion
    const Plan* plan = nullptr;           // made with it; null: none yet
    std::string object;                   // name of the only selected object; empty: none
    std::string change;                   // what the last repair changed; empty: none
    bool can_read_again = false;          // whether the motion's file is known
    int world = 0;                        // its coordinate system, index in motionWorlds()
    bool busy = false;                    // a motion is being read, repaired or made
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
    std::string make;        // move to make, as on the command line; empty: none
};

/// The coordinate systems of trajectory files; the first is the format's own, "".
std::span<const char* const> motionWorlds();

/// Draws the section on the given camera motion: import, repair, moves made from templates.
MotionActions drawMotionSection(const MotionView& view);

}  // namespace dollytrack::ui
