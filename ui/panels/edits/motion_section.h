#pragma once

#include "engine/document/given_motion.h"
#include "engine/plan/plan.h"
#include "ui/edit_request.h"
#include "ui/panels/edits/move_form.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// Whether the camera can be at a key of the camera path.
struct KeyState {
    std::string why_blocked;  // a phrase: "is in or too close to 'wall'"; empty: it can
    std::optional<Eigen::Vector3d> free_place = {};  // if not: the nearest position where it can
};

/// Input of the section for one window frame.
struct MotionView {
    const GivenMotion* motion = nullptr;  // null: the camera path is planned
    const Plan* plan = nullptr;           // made with it; null: none yet
    std::string why_not_checked;          // a sentence; empty: `plan` is there or will be
    bool has_scene = false;               // whether paths can be read and made
    int selected_key = -1;                // index of the selected key; -1: none
    std::vector<KeyState> key_states;     // of the keys; empty: not known yet
    MoveFormView move;
    std::string why_no_key;        // why no key can be added now; empty: it can
    std::string why_no_replacing;  // why no key can be replaced by the view now; empty: one can
    std::string change;            // what the last repair or obstacles to a move changed; or empty
    std::optional<std::string> why_not_compare;  // with the path before its repair; empty: it can;
                                                 // none: it is not the result of a repair
    bool can_read_again = false;                 // whether the path is from a file
    int world = 0;                               // its coordinate system, index in motionWorlds()
    std::string format;                          // of that file, a name of trajectoryFormats()
    std::string collision_here;                  // at the current frame; empty: none
    bool busy = false;                           // a path is being read, repaired or made
    double fraction = 0.0;                       // of that, 0..1
    std::string stage;
};

/// User actions of this frame.
struct MotionActions {
    EditRequest edit;
    bool import = false;  // ask for a file
    bool repair = false;
    bool compare = false;  // with the plan before the repair
    bool cancel = false;
    int read_in_world = -1;               // read the file again, in this coordinate system; -1: no
    MoveFormActions move;                 // buttons of the form for a camera move
    bool add_key = false;                 // from the viewport's view
    bool replace_key = false;             // the selected key, by the viewport's view
    bool fit_keys = false;                // give all keys the times at which they are reached
    int select_key = -1;                  // index of a key; -1: none
    std::optional<std::size_t> free_key;  // index of a key to move to its free place
    int collision = 0;  // go to the next collision (1) or the previous one (-1); 0: no
    std::optional<Pose> look_through;
};

/// The coordinate systems of trajectory files; the first is the format's own, "".
std::span<const char* const> motionWorlds();

/// A field for the time of a key, limited by the keys before and after it.
void keyTimeField(const std::vector<MotionKey>& keys, std::size_t key, const std::string& name,
                  EditRequest& edit);
/// The operation that removes a key, by its index.
[[nodiscard]] nlohmann::json removeCameraKeyOperation(std::size_t key);

/// Draws the section on the given camera motion: key frames, import, repair, and the form of a
/// move.
MotionActions drawMotionSection(const MotionView& view, MoveDraft& move);

}  // namespace dollytrack::ui
