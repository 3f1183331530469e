#include "app/editor/editor.h"

#include "app/editor/timeline/key_placement.h"
#include "planning/motions/key_motion.h"
#include "ui/panels/edits/edit_parts.h"

#include <GLFW/glfw3.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace dollytrack::editor {

using ui::Selection;

namespace {

nlohmann::json poseOperation(const char* op, const Pose& pose) {
    return {{"op", op},
            {"position", ui::pointJson(pose.position)},
            {"quaternion_xyzw", ui::turnJson(pose.rotation)}};
}

nlohmann::json changeOperation(std::size_t key, const Pose& pose) {
    nlohmann::json operation = poseOperation("change_camera_key", pose);
    operation["key"] = key + 1;
    return operation;
}

}  // namespace

void Editor::addCameraKeyCommands() {
    commands_.add({"edit.camera_key",
                   "Edit",
                   "Add this view to the camera path as a key",
                   {GLFW_KEY_K},
                   [this] { recordKey(); },
                   [this] { return whyNoKey(); }});
    commands_.add({"timeline.look_through_key",
                   "Timeline",
                   "Look through the selected key",
                   {GLFW_KEY_ENTER},
                   [this] { lookAlongPose(selectedKey()->pose); },
                   [this]() -> std::string {
                       return selectedKey() != nullptr ? "" : "Select a key of the camera path.";
                   }});
    commands_.add({"edit.fit_keys",
                   "Edit",
                   "Give all keys their reachable times",
                   {},
                   [this] { fitKeys(); },
                   [this]() -> std::string {
                       return passedKeys().empty() ? "There is no camera path with keys." : "";
                   }});
}

const std::vector<MotionKey>& Editor::cameraKeys() const {
    static const std::vector<MotionKey> kNone;
    if (!workspace_.isOpen()) return kNone;
    const SharedMotion& motion = workspace_.state().edits.plan.motion;
    return motion ? motion->keys : kNone;
}

const MotionKey* Editor::selectedKey() const {
    return workspace_.isOpen() ? selected_.cameraKey(workspace_.state().edits.plan.motion)
                               : nullptr;
}

const std::vector<PassedKey>& Editor::passedKeys() const {
    static const std::vector<PassedKey> kNone;
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.plan || !workspace_.isOpen()) return kNone;
    const bool is_current = shown.state->edits.plan.motion == workspace_.state().edits.plan.motion;
    return is_current ? shown.plan->passed_keys : kNone;
}

std::string Editor::whyNoKey() const {
    if (!workspace_.isOpen() || !workspace_.shown().scene) return "No scene is open.";
    if (workspace_.state().edits.plan.motion && cameraKeys().empty()) {
        return "Remove the imported camera path first (By hand, Plan instead).";
    }
    return panels_.viewport.camera.orthographic && !through_camera_
               ? "Switch to perspective (5) first."
               : "";
}

void Editor::recordKey() {
    const Pose view = viewportView(panels_.viewport.camera).pose;
    const int selected = selectedKey() != nullptr ? selected_.now().index : -1;
    const Plan* of_keys = passedKeys().empty() ? nullptr : plan();
    const KeyPlacement place = placeKey(cameraKeys(), of_keys, playback_.frame(), selected, view,
                                        workspace_.shown().params.timing);
    if (place.replaces) {
        apply(changeOperation(*place.replaces, view));
        return;
    }
    nlohmann::json operation = poseOperation("add_camera_key", view);
    operation["time_s"] = place.time_s;
    apply(operation);
    recorded_key_s_ = place.time_s;
}

void Editor::moveSelectedKey(const Pose& pose) {
    const MotionKey* key = selectedKey();
    if (key == nullptr) return;
    nlohmann::json operation = changeOperation(selected_.index(), pose);
    // A rotation that is given loses its roll; one that is not given stays as it is.
    if (pose.rotation.coeffs() == key->pose.rotation.coeffs()) operation.erase("quaternion_xyzw");
    apply(operation);
}

void Editor::dropOutdatedKeySelection() {
    const std::size_t before = std::exchange(key_count_, cameraKeys().size());
    if (before == key_count_ || !selected_.is(Selection::Kind::CameraKey)) return;
    dropGizmo();
    selected_.clear();
}

void Editor::goToRecordedKey() {
    if (!recorded_key_s_ || !workspace_.planIsCurrent() || passedKeys().empty()) return;
    const auto& keys = cameraKeys();
    const auto at = std::ranges::find(keys, *recorded_key_s_, &MotionKey::time_s);
    recorded_key_s_.reset();
    if (at == keys.end()) return;
    goToFrame(passedKeys()[static_cast<std::size_t>(at - keys.begin())].frame);
}

void Editor::fitKeys() {
    GivenMotion motion = *workspace_.state().edits.plan.motion;
    motion.keys = planning::withReachedTimes(std::move(motion.keys), passedKeys(),
                                             1.0 / workspace_.shown().params.timing.frame_rate);
    nlohmann::json operation = motionJson(motion);
    operation["op"] = "set_motion";
    apply(operation);
}

std::vector<ui::TimelineCameraKey> Editor::timelineCameraKeys() const {
    std::vector<ui::TimelineCameraKey> shown;
    for (const MotionKey& key : cameraKeys()) shown.push_back({key.time_s, key.time_s, {}});
    const std::vector<PassedKey>& passed = passedKeys();
    for (std::size_t i = 0; i < std::min(passed.size(), shown.size()); ++i) {
        shown[i].reached_s = passed[i].time_s;
        shown[i].note = passed[i].note;
    }
    return shown;
}

void Editor::follow(const ui::TimelineActions& actions) {
    if (actions.select_key)
        select(Selection::ofItem(Selection::Kind::CameraKey, *actions.select_key));
    if (actions.go_to) goToFrame(*actions.go_to);
    if (actions.toggle_play) commands_.find("timeline.play")->run();
    if (actions.fly_to_key) {
        lookAlongPose(cameraKeys()[static_cast<std::size_t>(*actions.fly_to_key)].pose);
    }
    if (actions.retime) {
        apply({{"op", "change_camera_key"},
               {"key", actions.retime->key + 1},
               {"time_s", actions.retime->time_s}});
    }
}

}  // namespace dollytrack::editor
