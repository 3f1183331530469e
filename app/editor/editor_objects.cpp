#include "app/editor/editor.h"

#include "engine/document/apply_scene_edits.h"
#include "engine/document/object_track.h"
#include "engine/geometry/ray_caster.h"
#include "engine/plan/object_key.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/timeline/track_bar.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace dollytrack::editor {

using ui::Selection;

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
const std::string kTimeMerge = "track time";

ObjectMove moveOf(const Edits& edits, const Scene& scene, int id) {
    const ObjectChange* change = ui::findChange(edits, scene, id);
    return change != nullptr ? change->move.value_or(ObjectMove{}) : ObjectMove{};
}

/// The rotation closest to the current one that gives this heading, so that motion between keys
/// takes the short way; within one turn either way.
double turnDegrees(double heading, double turn_rad) {
    constexpr double kRound = 2.0 * std::numbers::pi;
    const double next = turn_rad + std::remainder(heading - turn_rad, kRound);
    return (std::abs(next) <= kRound ? next : std::remainder(next, kRound)) * kDegrees;
}

/// Draws the edges of a box over the viewport.
void drawOutline(const OrientedBox& box, const ui::GizmoView& view) {
    const std::array<Eigen::Vector3d, 8> corners = box.corners();
    std::array<std::optional<ImVec2>, 8> at;
    for (std::size_t i = 0; i < 8; ++i) at[i] = ui::positionInWindow(view, corners[i]);
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t k = i + 1; k < 8; ++k) {
            // Two corners share an edge if they differ along one axis of the box.
            const Eigen::Vector3d way = corners[k] - corners[i];
            int along = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const Eigen::Vector3d own =
                    axis == 2
                        ? Eigen::Vector3d::UnitZ().eval()
                        : Eigen::Vector3d(std::cos(box.yaw + axis * 0.5 * std::numbers::pi),
                                          std::sin(box.yaw + axis * 0.5 * std::numbers::pi), 0.0);
                along += std::abs(way.dot(own)) > 1e-6 ? 1 : 0;
            }
            if (along != 1 || !at[i] || !at[k]) continue;
            ImGui::GetWindowDrawList()->AddLine(*at[i], *at[k], IM_COL32(255, 214, 70, 220),
                                                ui::scaled(1.6F));
        }
    }
}

}  // namespace

std::vector<int> Editor::movableObjects() const {
    const PlanOutcome& shown = workspace_.shown();
    const bool objects =
        selected_.is(Selection::Kind::Object) || selected_.is(Selection::Kind::Objects);
    if (!objects || !shown.scene || !workspace_.isOpen()) return {};
    // Object ids are unreliable while merges or splits are being applied.
    if (shown.state->edits.scene.definitions != workspace_.state().edits.scene.definitions) {
        return {};
    }
    const auto count = static_cast<int>(shown.scene->objects.size());
    const bool known =
        std::ranges::all_of(selected_.objects(), [&](int id) { return id >= 1 && id <= count; });
    return known ? selected_.objects() : std::vector<int>();
}

int Editor::movableObject() const {
    const std::vector<int> ids = movableObjects();
    return ids.size() == 1 ? ids[0] : 0;
}

OrientedBox Editor::objectBox(int id) const {
    const PlanOutcome& shown = workspace_.shown();
    const ObjectMove before = moveOf(shown.state->edits, *shown.scene, id);
    const ObjectMove now = moveOf(workspace_.state().edits, *shown.scene, id);
    OrientedBox box = shown.scene->object(id).box;
    box.center += now.offset_m - before.offset_m;
    box.yaw += now.turn_rad - before.turn_rad;
    return box;
}

Pose Editor::poseOfObjects(const std::vector<int>& ids) const {
    Pose pose;
    pose.position.setZero();
    for (const int id : ids) pose.position += objectBox(id).center;
    pose.position /= static_cast<double>(ids.size());
    const double turn_rad =
        ids.size() > 1
            ? 0.0
            : moveOf(workspace_.state().edits, *workspace_.shown().scene, ids[0]).turn_rad;
    pose.rotation = lookAlong({std::cos(turn_rad), std::sin(turn_rad), 0.0});
    return pose;
}

std::vector<ui::MovedObject> Editor::movedObjects() const {
    const PlanOutcome& shown = workspace_.shown();
    std::vector<ui::MovedObject> moved;
    if (!workspace_.isOpen() || !shown.scene || shown.state == workspace_.history().state()) {
        return moved;
    }
    const Edits& before = shown.state->edits;
    const Edits& now = workspace_.state().edits;
    // Object ids are unreliable while merges or splits are being applied.
    if (before.scene.definitions != now.scene.definitions) return moved;
    std::set<int> ids;
    for (const Edits* edits : {&before, &now}) {
        for (const ObjectChange& change : edits->scene.changes) {
            if (change.move) ids.insert(findObject(*shown.scene, change.object));
        }
    }
    ids.erase(0);
    for (const int id : ids) {
        const ObjectMove from = moveOf(before, *shown.scene, id);
        const ObjectMove to = moveOf(now, *shown.scene, id);
        if (from == to) continue;
        const Eigen::Vector3d& middle = shown.scene->object(id).box.center;
        const Eigen::AngleAxisd turn(to.turn_rad - from.turn_rad, Eigen::Vector3d::UnitZ());
        Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
        motion.translate(middle + to.offset_m - from.offset_m).rotate(turn).translate(-middle);
        moved.push_back({id, motion});
    }
    return moved;
}

void Editor::moveWithGizmo(const ui::GizmoView& view, const std::vector<int>& ids) {
    const PlanOutcome& shown = workspace_.shown();
    const Edits& edits = workspace_.state().edits;
    if (!gizmo_.dragging() || !std::ranges::equal(before_drag_, ids, {}, &DraggedObject::id)) {
        before_drag_.clear();
        for (const int id : ids) {
            before_drag_.push_back({id, moveOf(edits, *shown.scene, id), objectBox(id).center});
        }
    }
    for (const int id : ids) {
        const bool moved =
            !(moveOf(edits, *shown.scene, id) == moveOf(shown.state->edits, *shown.scene, id));
        if (gizmo_.dragging() || moved) drawOutline(objectBox(id), view);
    }
    const ui::GizmoActions actions = gizmo_.draw(view);
    if (actions.changed) moveDragged(actions.change);
    if (actions.finished) finishDrag();
    if (gizmo_.dragging()) window_.animate();
    // The gizmo covers the centre of the selection; clicks go to what lies behind it.
    if (actions.clicked) clickAt(pane_.cursor, actions.with_ctrl, actions.with_alt);
}

void Editor::moveDragged(const ui::PoseChange& change) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const DraggedObject& object : before_drag_) middle += object.center;
    middle /= static_cast<double>(before_drag_.size());
    const Eigen::AngleAxisd turn(change.yaw_rad, Eigen::Vector3d::UnitZ());
    nlohmann::json moves = nlohmann::json::array();
    for (const auto& [id, before, center] : before_drag_) {
        nlohmann::json move = {{"object", objectKey(*workspace_.shown().scene, id)}};
        Eigen::Vector3d by = change.offset_m;
        if (gizmo_.turning()) {
            by += middle + turn * (center - middle) - center;
            move["turn_deg"] = turnDegrees(before.turn_rad + change.yaw_rad, before.turn_rad);
        }
        move["offset"] = ui::pointJson(before.offset_m + by);
        moves.push_back(std::move(move));
    }
    applyMoves(moves, "gizmo objects");
}

void Editor::applyMoves(const nlohmann::json& moves, const std::string& merge_key) {
    nlohmann::json operation = {{"op", "move_objects"}, {"moves", moves}};
    if (moves.size() == 1) {
        operation = moves[0];
        operation["op"] = "move_object";
    }
    apply(operation, merge_key);
}

OrientedBox Editor::boxInView() {
    const ui::ViewImage& image = drawing_.view();
    const ui::ViewerCamera& camera = panels_.viewport.camera;
    const double size = std::clamp(std::round(camera.distance * 2.0) / 10.0, 0.3, 1.0);
    Eigen::Vector3d base = camera.pivot;
    const PlanOutcome& shown = workspace_.shown();
    const bool is_shown = shown.hasObjectsOf(image.geometry);
    if (const auto surface =
            is_shown ? ui::surfaceAt(image, 0.5 * Eigen::Vector2d(pane_.width, pane_.height))
                     : std::nullopt) {
        // On a wall, the box is placed in front of it.
        const Eigen::Vector3d way = image.view.pose.position - *surface;
        const Eigen::Vector3d level = Eigen::Vector3d(way.x(), way.y(), 0.0).normalized();
        const bool on_top =
            shown.rays && shown.rays
                                  ->cast(*surface + 0.02 * Eigen::Vector3d::UnitZ() + 0.02 * level,
                                         -Eigen::Vector3d::UnitZ(), 0.1)
                                  .object_id != 0;
        base = on_top ? *surface : Eigen::Vector3d(*surface + 0.55 * size * level);
    }
    // The box is placed on the surface below, if there is one.
    if (shown.rays) {
        const RayHit below =
            shown.rays->cast(base + 0.05 * Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ());
        if (below.object_id != 0) base.z() += 0.05 - below.distance;
    }
    return {base + 0.5 * size * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Constant(0.5 * size),
            0.0};
}

void Editor::addTransformCommands() {
    const auto why_not = [this](bool turns) -> std::string {
        const std::optional<ui::GizmoView> view = gizmoView();
        if (!view && !movableObjects().empty()) {
            return "A selected object is hidden; show it first (Alt+H).";
        }
        if (!view) return "Select objects, a position point or a box first.";
        return turns && !view->turns ? "Boxes cannot be rotated." : "";
    };
    commands_.add({"edit.move",
                   "Edit",
                   "Move the selection (X, Y, Z, number)",
                   {GLFW_KEY_G},
                   [this] { startKeyTransform(ui::GizmoPart::MoveFree); },
                   [why_not] { return why_not(false); }});
    commands_.add({"edit.rotate",
                   "Edit",
                   "Rotate the selection (number)",
                   {GLFW_KEY_R},
                   [this] { startKeyTransform(ui::GizmoPart::Yaw); },
                   [why_not] { return why_not(true); }});
}

void Editor::addObjectCommands() {
    const auto needs_object = [this]() -> std::string {
        return movableObject() != 0 ? "" : "Select one object first.";
    };
    const auto needs_moved = [this]() -> std::string {
        if (movableObjects().empty()) return "Select objects first.";
        const bool moved = std::ranges::any_of(movableObjects(), [&](int id) {
            const ObjectChange* change =
                ui::findChange(workspace_.state().edits, *workspace_.shown().scene, id);
            return change != nullptr && (change->move || !change->track.empty());
        });
        return moved ? "" : "No selected object was moved or rotated.";
    };
    const auto putBack = [this](const char* what, const nlohmann::json& value) {
        nlohmann::json moves = nlohmann::json::array();
        for (const int id : movableObjects()) {
            moves.push_back({{"object", objectKey(*workspace_.shown().scene, id)}, {what, value}});
        }
        applyMoves(moves);
    };
    commands_.add({"edit.clear_move",
                   "Edit",
                   "Clear the moves of the objects",
                   {GLFW_KEY_G, false, false, true},
                   [putBack] { putBack("offset", ui::pointJson(Eigen::Vector3d::Zero())); },
                   needs_moved});
    commands_.add({"edit.clear_turn",
                   "Edit",
                   "Clear the rotations of the objects",
                   {GLFW_KEY_R, false, false, true},
                   [putBack] { putBack("turn_deg", 0.0); },
                   needs_moved});
    commands_.add({"edit.add_key",
                   "Edit",
                   "Add a key to the object at this time",
                   {GLFW_KEY_I},
                   [this] {
                       apply(ui::addKeyOperation(workspace_.state().edits,
                                                 *workspace_.shown().scene, movableObject(),
                                                 track_time_.now()));
                   },
                   needs_object});
    commands_.add({"edit.remove_key",
                   "Edit",
                   "Remove the object's key at this time",
                   {GLFW_KEY_I, false, false, true},
                   [this] { apply(removeKeyHere()); },
                   [this, needs_object]() -> std::string {
                       const std::string why_not = needs_object();
                       if (!why_not.empty()) return why_not;
                       return removeKeyHere().is_null() ? "It has no key at this time." : "";
                   }});
    commands_.add({"timeline.play_tracks",
                   "Timeline",
                   "Play object tracks",
                   {GLFW_KEY_SPACE, false, true},
                   [this] { playTracks(); },
                   [this]() -> std::string {
                       const bool any = workspace_.isOpen() &&
                                        lastKeyTime(workspace_.state().edits.scene).value_or(0) > 0;
                       return any ? "" : "No object has two keys.";
                   }});
}

Role Editor::newestRole(int object) const {
    const Scene& scene = *workspace_.shown().scene;
    const ObjectChange* change = ui::findChange(workspace_.state().edits, scene, object);
    const Role shown = scene.object(object).role;
    return change != nullptr ? change->role.value_or(shown) : shown;
}

nlohmann::json Editor::removeKeyHere() const {
    return ui::removeKeyOperation(workspace_.state().edits, *workspace_.shown().scene,
                                  movableObject(), track_time_.now());
}

void Editor::playTracks() {
    // Playing is one undo step.
    workspace_.endMerge();
    track_time_.toggle(lastKeyTime(workspace_.state().edits.scene).value_or(0.0));
}

void Editor::goToTrackTime(double time_s) {
    if (track_time_.playing()) workspace_.endMerge();  // playing was an undo step of its own
    track_time_.goTo(time_s);
    apply({{"op", "at_time"}, {"time_s", time_s}}, kTimeMerge);
}

void Editor::followTracks() {
    if (!workspace_.isOpen()) return;
    const SceneEdits& edits = workspace_.state().edits.scene;
    // A drag takes precedence over playing; both at once would break each other's undo steps.
    if (track_time_.playing() && gizmo_.dragging()) {
        track_time_.stop();
        workspace_.endMerge();
    }
    if (track_time_.playing()) {
        window_.animate();
        const PlanOutcome& shown = workspace_.shown();
        const bool ready = shown.plan != nullptr && shown.state == workspace_.history().state();
        const double last_s = lastKeyTime(edits).value_or(0.0);
        if (const auto time_s = track_time_.advance(ImGui::GetIO().DeltaTime, last_s, ready)) {
            apply({{"op", "at_time"}, {"time_s", *time_s}}, kTimeMerge);
            if (!track_time_.playing()) workspace_.endMerge();
        }
        // Stops if planning fails: the next time would never become due.
        if (!workspace_.planError().empty()) {
            track_time_.stop();
            workspace_.endMerge();
        }
    }
    // Undo and other edits may have moved the objects.
    if (followed_tracks_ != workspace_.history().state()) {
        followed_tracks_ = workspace_.history().state();
        track_time_.follow(workspace_.state().edits.scene);
    }
}

bool Editor::hasTracks() const {
    return workspace_.isOpen() && workspace_.shown().scene &&
           lastKeyTime(workspace_.state().edits.scene).has_value();
}

void Editor::drawTracks() {
    if (!hasTracks()) return;
    const Edits& edits = workspace_.state().edits;
    const double last_s = *lastKeyTime(edits.scene);
    ui::TrackBarView view;
    view.time_s = track_time_.now();
    view.last_s = last_s;
    view.is_there = track_time_.isThere();
    view.playing = track_time_.playing();
    if (const int id = movableObject(); id != 0) {
        if (const ObjectChange* change = ui::findChange(edits, *workspace_.shown().scene, id)) {
            for (const TrackKey& key : change->track) view.keys_s.push_back(key.time_s);
        }
    }
    const ui::TrackBarActions actions = ui::drawTrackBar(view);
    if (actions.go_to_s) goToTrackTime(*actions.go_to_s);
    if (actions.finished) workspace_.endMerge();
    if (actions.toggle_play) playTracks();
}

}  // namespace dollytrack::editor
