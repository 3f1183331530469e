#include "app/editor/editor.h"

#include "app/editor/timeline/key_placement.h"
#include "engine/geometry/ray_caster.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/colliding_frames.h"
#include "planning/motions/motion_check.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/widgets/note_bar.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace dollytrack::editor {

using ui::Selection;

namespace {

/// The maps of the displayed plan, which must have them.
planning::MappedScene mapOfShown(const PlanOutcome& shown) {
    planning::MappedScene map;
    map.scene = shown.scene;
    map.rays = shown.rays;
    map.free_space = shown.free_space;
    map.region = shown.region;
    map.sphere = std::make_shared<const planning::SweptSphere>(
        *shown.rays, *shown.free_space, shown.params.camera.camera_radius_m, shown.region.get());
    return map;
}

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
                   "Camera",
                   "Add this view to the camera path as a key",
                   {GLFW_KEY_K},
                   [this] { recordKey(); },
                   [this] { return whyNoKey(); }});
    commands_.add({"edit.replace_camera_key",
                   "Camera",
                   "Replace the selected key by this view",
                   {GLFW_KEY_K, false, true},
                   [this] { replaceKey(); },
                   [this] { return whyNoReplacing(); }});
    commands_.add({"timeline.look_through_key",
                   "Timeline",
                   "Look through the selected key",
                   {GLFW_KEY_ENTER},
                   [this] { lookAlongPose(selectedKey()->pose); },
                   [this]() -> std::string {
                       return selectedKey() != nullptr ? "" : "Select a key of the camera path.";
                   }});
    commands_.add(
        {"edit.fit_keys",
         "Camera",
         "Give all keys their reachable times",
         {},
         [this] { motions_.fitKeys(workspace_.state().edits.plan.motion, workspace_.shown()); },
         [this]() -> std::string {
             return passedKeys().empty() ? "There is no camera path with keys." : "";
         }});
}

void Editor::goToCollision(int direction) {
    const std::vector<planning::CollidingFrames>& collisions = plan_timeline_.collisions();
    if (collisions.empty()) return;
    const auto first = &planning::CollidingFrames::first;
    // Wraps around: the first collision follows the last one.
    if (direction > 0) {
        const auto next = std::ranges::upper_bound(collisions, playback_.frame(), {}, first);
        goToFrame(next == collisions.end() ? collisions.front().first : next->first);
    } else {
        const auto next = std::ranges::lower_bound(collisions, playback_.frame(), {}, first);
        goToFrame(next == collisions.begin() ? collisions.back().first : (next - 1)->first);
    }
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
        return "Remove the camera path first (By hand, Plan instead).";
    }
    return panels_.viewport.camera.orthographic && !through_camera_
               ? "Switch to perspective (5) first."
               : "";
}

void Editor::recordKey() {
    const Pose view = viewPose();
    const std::vector<MotionKey>& keys = cameraKeys();
    int after = selectedKey() != nullptr ? selected_.now().index : -1;
    if (after < 0 && recorded_key_s_) {  // the playhead has not reached the latest key yet
        const auto latest = std::ranges::find(keys, *recorded_key_s_, &MotionKey::time_s);
        if (latest != keys.end()) after = static_cast<int>(latest - keys.begin());
    }
    const Plan* of_keys = passedKeys().empty() ? nullptr : plan();
    nlohmann::json operation = poseOperation("add_camera_key", view);
    const double time_s = timeOfNewKey(keys, of_keys, playback_.frame(), after, view,
                                       workspace_.shown().params.timing);
    operation["time_s"] = time_s;
    apply(operation);
    recorded_key_s_ = time_s;
    noteRecordedKey(time_s);
}

void Editor::noteRecordedKey(double time_s) {
    const auto& now = cameraKeys();
    const auto at = std::ranges::find(now, time_s, &MotionKey::time_s);
    if (at == now.end()) return;
    recorded_key_ = {workspace_.state().edits.plan.motion,
                     static_cast<std::size_t>(at - now.begin())};
}

std::optional<std::size_t> Editor::keyToReplace() const {
    if (selectedKey() != nullptr) return selected_.index();
    return keyAtPlayhead(cameraKeys(), passedKeys().empty() ? nullptr : plan(), playback_.frame());
}

std::string Editor::whyNoReplacing() const {
    if (std::string why = whyNoKey(); !why.empty()) return why;
    return keyToReplace() ? "" : "Select a key of the camera path.";
}

void Editor::replaceKey() {
    if (const std::optional<std::size_t> key = keyToReplace()) {
        const double time_s = cameraKeys()[*key].time_s;
        apply(changeOperation(*key, viewPose()));
        noteRecordedKey(time_s);
    }
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

std::string Editor::collisionHere() const {
    const PlanOutcome& shown = workspace_.shown();
    const int frame = playback_.frame();
    const auto& collisions = plan_timeline_.collisions();
    const auto here = std::ranges::find_if(
        collisions, [&](const auto& one) { return one.first <= frame && frame <= one.last; });
    if (here == collisions.end() || plan() == nullptr || frame >= frameCount()) return {};
    if (!shown.free_space || !shown.rays) return {};
    if (here->object_id != 0) {
        return fmt::format("Frame {} collides with {}.", frame,
                           shown.scene->object(here->object_id).name);
    }
    const planning::MappedScene map = mapOfShown(shown);
    const Eigen::Vector3d& position = plan()->trajectory.frames[frame].pose.position;
    return planning::MotionCheck(map).isFree(position)
               ? fmt::format("The move at frame {} collides.", frame)
               : fmt::format("Frame {} {}.", frame, planning::whyNotFree(map, position));
}

const Editor::KeyStates& Editor::keyStates() {
    const PlanOutcome& shown = workspace_.shown();
    const SharedMotion motion =
        workspace_.isOpen() ? workspace_.state().edits.plan.motion : SharedMotion();
    if (key_states_.motion == motion && key_states_.region == shown.region &&
        key_states_.free_space == shown.free_space) {
        return key_states_;
    }
    key_states_ = {motion, shown.free_space, shown.region, {}};
    if (!motion || !shown.free_space || !shown.rays) return key_states_;
    const planning::MappedScene scene = mapOfShown(shown);
    const planning::MotionCheck check(scene);
    for (const MotionKey& key : motion->keys) {
        ui::KeyState& state = key_states_.keys.emplace_back();
        if (check.isFree(key.pose.position)) continue;
        state.why_blocked = planning::whyNotFree(scene, key.pose.position);
        state.free_place = planning::nearestFree(scene, key.pose.position);
    }
    return key_states_;
}

void Editor::freeKey(std::size_t key) {
    const auto& states = keyStates().keys;
    if (key >= states.size() || !states[key].free_place) return;
    apply({{"op", "change_camera_key"},
           {"key", key + 1},
           {"position", ui::pointJson(*states[key].free_place)}});
}

void Editor::drawKeyBar() {
    if (!recorded_key_ || !workspace_.isOpen() ||
        !(workspace_.state().edits.plan.motion == recorded_key_->motion)) {
        recorded_key_.reset();
        return;
    }
    const std::size_t key = recorded_key_->key;
    const auto& states = keyStates().keys;
    if (key >= states.size()) return;
    if (states[key].why_blocked.empty()) {
        drawFirstKeyBar();
        return;
    }
    std::vector<ui::NoteBarButton> buttons = {{"Keep", "Hide this bar; the key stays marked"},
                                              {"Remove", "Remove the key again"}};
    if (const auto& free_place = states[key].free_place) {
        const double away_m = (*free_place - cameraKeys()[key].pose.position).norm();
        buttons.push_back({fmt::format("Move it by {:.2f} m", away_m),
                           "Move the key to the nearest place where the camera fits"});
    }
    const int pressed = ui::drawNoteBar(
        "key_blocked",
        fmt::format("Key {} {}: the camera cannot be there.", key + 1, states[key].why_blocked),
        buttons);
    if (pressed < 0) return;
    recorded_key_.reset();
    if (pressed == 1) apply(ui::removeCameraKeyOperation(key));
    if (pressed == 2) freeKey(key);
}

void Editor::drawFirstKeyBar() {
    if (cameraKeys().size() != 1) return;
    const int pressed = ui::drawNoteBar(
        "key_first", "The camera follows keys now, not the planned path: go on and press K.",
        {{"OK", "Hide this bar"}, {"Plan instead", "Remove the key and plan the path again"}});
    if (pressed >= 0) recorded_key_.reset();
    if (pressed == 1) apply({{"op", "clear_motion"}});
}

std::vector<ui::TimelineCameraKey> Editor::timelineCameraKeys() {
    std::vector<ui::TimelineCameraKey> shown;
    for (const MotionKey& key : cameraKeys()) shown.push_back({key.time_s, key.time_s, {}});
    const std::vector<PassedKey>& passed = passedKeys();
    for (std::size_t i = 0; i < std::min(passed.size(), shown.size()); ++i) {
        shown[i].reached_s = passed[i].time_s;
        shown[i].note = passed[i].note;
    }
    // A blocked key is marked before it is planned.
    const std::vector<ui::KeyState>& states = keyStates().keys;
    for (std::size_t i = 0; i < std::min(states.size(), shown.size()); ++i) {
        if (!shown[i].note.empty() || states[i].why_blocked.empty()) continue;
        shown[i].note = fmt::format("Key {} {}.", i + 1, states[i].why_blocked);
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
