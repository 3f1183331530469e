#include "app/editor/editor.h"

#include "engine/core/log.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>

namespace dollytrack::editor {

namespace {

/// The name of the undo step that changes the camera path.
std::string stepName(MotionWorker::Source source, const std::string& motion) {
    switch (source) {
        case MotionWorker::Source::File:
            return "Import the camera path " + motion;
        case MotionWorker::Source::Repair:
            return "Repair the camera path";
        case MotionWorker::Source::Move:
            return "Make the camera move " + motion.substr(0, motion.find(':'));
        case MotionWorker::Source::KeyTimes:
            break;
    }
    return "Set reachable times of the keys";
}

std::string lengthText(double length_m) {
    return length_m < 1.0 ? fmt::format("{:.1f} cm", 100.0 * length_m)
                          : fmt::format("{:.2f} m", length_m);
}

std::string changeText(const planning::MotionChange& change) {
    if (change.frames_moved == 0 && change.time_added_s == 0.0 && change.paths_cut == 0) {
        return "Nothing had to change.";
    }
    std::string text = "The positions stay";
    if (change.frames_moved > 0) {
        text = fmt::format(
            "{} frames moved, at most by {} and {:.0f}\u00b0 (mean of all frames: {})",
            change.frames_moved, lengthText(change.largest_shift_m),
            change.largest_turn_rad * 180.0 / std::numbers::pi, lengthText(change.mean_shift_m));
    }
    if (change.frames_moved > 0 || change.paths_cut > 0) {
        text += fmt::format("; {:.1f} m long instead of {:.1f} m", change.length_m,
                            change.given_length_m);
    }
    if (change.time_added_s > 0.0) {
        text += fmt::format("; {:.1f} s longer, to meet the limits of speed and turning",
                            change.time_added_s);
    }
    if (change.paths_cut > 0) {
        text += fmt::format("; cut at {} place{} where no collision-free path exists",
                            change.paths_cut, change.paths_cut == 1 ? "" : "s");
    }
    return text + ".";
}

}  // namespace

void Editor::addMotionCommands() {
    for (const planning::MoveKind& kind : planning::moveKinds()) {
        commands_.add({fmt::format("edit.move.{}", kind.name),
                       "Camera",
                       fmt::format("Camera move: {}\u2026", kind.name),
                       {},
                       [this, name = std::string(kind.name)] {
                           panels_.move.kind = name;
                           docks_.open(panelName(Panel::ByHand));
                       },
                       [this]() -> std::string {
                           return workspace_.shown().scene ? "" : "No scene is open.";
                       }});
    }
    const auto needs_plan = [this]() -> std::string {
        if (!workspace_.shown().scene) return "No scene is open.";
        return motions_.state().busy ? "A camera path is being read or made." : "";
    };
    const auto needs_motion = [this, needs_plan]() -> std::string {
        if (std::string why = needs_plan(); !why.empty()) return why;
        return workspace_.state().edits.plan.motion ? "" : "Import a camera path first.";
    };
    const auto needs_frames = [this, needs_motion]() -> std::string {
        if (std::string why = needs_motion(); !why.empty()) return why;
        return cameraKeys().empty() ? "" : "A path through keys avoids collisions anyway.";
    };
    commands_.add(
        {"edit.repair_motion",
         "Camera",
         "Repair the camera path",
         {},
         [this] { motions_.repair(workspace_.state().edits.plan.motion, workspace_.shown()); },
         needs_frames});
    for (const bool before : {true, false}) {
        commands_.add({before ? "edit.trim_before" : "edit.trim_after",
                       "Camera",
                       before ? "Remove the camera path before this frame"
                              : "Remove the camera path after this frame",
                       {},
                       [this, before] { trimMotion(before); },
                       [this, needs_motion]() -> std::string {
                           if (std::string why = needs_motion(); !why.empty()) return why;
                           return workspace_.planIsCurrent() ? "" : "Planning is still running.";
                       }});
    }
    commands_.add({"edit.clear_motion",
                   "Camera",
                   "Plan instead of following the camera path",
                   {},
                   [this] {
                       apply({{"op", "clear_motion"}});
                   },
                   needs_motion});
}

ui::MotionView Editor::motionView() {
    ui::MotionView view;
    if (!workspace_.isOpen()) return view;
    const PlanOutcome& shown = workspace_.shown();
    const SharedMotion& motion = workspace_.state().edits.plan.motion;
    if (motion) view.motion = &*motion;
    if (workspace_.planIsCurrent()) view.plan = shown.plan.get();
    if (workspace_.planningStopped()) {
        view.why_not_checked = "Not checked: planning was stopped.";
    } else if (!workspace_.planError().empty()) {
        view.why_not_checked = "Not checked: planning failed.";
    }
    view.has_scene = shown.scene != nullptr;
    view.move.why_not = view.has_scene ? "" : "No scene is open.";
    if (view.has_scene && selected_.objects().size() == 1) {
        view.move.target = shown.scene->object(selected_.objects().front()).name;
    }
    view.move.has_path = move_preview_.preview() != nullptr;
    view.move.note =
        move_preview_.error() != nullptr ? moveFault(*move_preview_.error()) : move_preview_.note();
    view.move.eye = viewPose().position;
    view.move.pivot = panels_.viewport.camera.pivot;
    view.key_states = keyStates().keys;
    if (selectedKey() != nullptr) view.selected_key = selected_.now().index;
    view.why_no_key = whyNoKey();
    view.why_no_replacing = whyNoReplacing();
    if (motion && motion == repaired_motion_) {
        view.change = motion_change_;
        view.why_not_compare =
            before_repair_ ? "" : "The path was repaired before its plan was ready.";
    }
    if (motion && motion == made_motion_) view.change = move_note_;
    if (const MotionFile* file = motionFile()) {
        const auto worlds = ui::motionWorlds();
        view.can_read_again = true;
        view.world = static_cast<int>(std::ranges::find(worlds, file->world) - worlds.begin());
        view.format = file->format;
    }
    view.collision_here = collisionHere();
    const BackgroundWorker::State job = motions_.state();
    view.busy = job.busy;
    view.fraction = job.fraction;
    view.stage = job.stage;
    return view;
}

void Editor::follow(const ui::MotionActions& actions) {
    applyRequest(actions.edit);
    if (actions.import) askForFile("camera path");
    if (actions.repair) {
        motions_.repair(workspace_.state().edits.plan.motion, workspace_.shown());
    }
    if (actions.compare && before_repair_) {
        comparison_.keep(*before_repair_);
        docks_.open(panelName(Panel::Metrics));
    }
    if (actions.add_key) recordKey();
    if (actions.replace_key) replaceKey();
    if (actions.fit_keys)
        motions_.fitKeys(workspace_.state().edits.plan.motion, workspace_.shown());
    if (actions.free_key) freeKey(*actions.free_key);
    if (actions.collision != 0) goToCollision(actions.collision);
    if (actions.select_key >= 0) {
        select(ui::Selection::ofItem(ui::Selection::Kind::CameraKey, actions.select_key));
    }
    if (actions.look_through) lookAlongPose(*actions.look_through);
    if (actions.cancel) motions_.cancel();
    if (actions.read_in_world >= 0) {
        const auto world = static_cast<std::size_t>(actions.read_in_world);
        if (const MotionFile* file = motionFile()) {
            readMotion({file->path, ui::motionWorlds()[world]});
        }
    }
    if (actions.move.make) makeMove();
    if (actions.move.show) showMove();
}

void Editor::trimMotion(bool before) {
    if (plan() == nullptr || playback_.frame() >= frameCount()) return;
    // Times of frames are rounded in a plan.
    const double here_s = plan()->trajectory.frames[playback_.frame()].time_s;
    const double rounding_s = 0.01 * plan()->trajectory.frame_interval_s;
    const double at_s = std::max(0.0, before ? here_s - rounding_s : here_s + rounding_s);
    apply({{"op", "trim_motion"}, {before ? "from_s" : "to_s", at_s}});
    if (before) goToFrame(0);
}

const MotionFile* Editor::motionFile() const {
    const SharedMotion& motion = workspace_.state().edits.plan.motion;
    const auto read = std::ranges::find(read_motions_, motion, &ReadMotion::motion);
    return motion && read != read_motions_.end() ? &read->file : nullptr;
}

void Editor::readMotion(const MotionFile& file) {
    if (!workspace_.shown().scene) return;  // closed while the file was chosen
    docks_.open(panelName(Panel::ByHand));
    const auto read = [this, file] { motions_.read(file, workspace_.shown()); };
    if (cameraKeys().empty()) return read();
    questions_.ask({"Replace the key frames?",
                    fmt::format("The camera path has {} key frames. Undo brings them back.",
                                cameraKeys().size()),
                    {{"Replace", read}}});
}

planning::MoveRequest Editor::moveOfForm() const {
    planning::MoveRequest move = panels_.move.request();
    // A point that is set to look at takes precedence over the selection.
    if (selected_.objects().size() == 1 && !move.options.contains("center")) {
        move.object_id = selected_.objects().front();
    }
    return move;
}

void Editor::followMoveForm() {
    const bool wanted = !panels_.move.kind.empty() && docks_.isOpen(panelName(Panel::ByHand)) &&
                        workspace_.isOpen() && workspace_.shown().scene && !through_camera_ &&
                        !motions_.state().busy;
    // While planning, the path of the previous plan stays visible.
    if (wanted && workspace_.planning().busy) return;
    move_preview_.follow(wanted ? std::optional(moveOfForm()) : std::nullopt, workspace_.shown());
}

void Editor::showMove() {
    if (move_preview_.preview() == nullptr) return;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : move_preview_.preview()->path) box.extend(position);
    bringIntoView(box);
}

void Editor::drawMove() {
    if (gizmo_.usesKeys()) return;
    if (auto before = move_preview_.draw(handleView(), panels_.move)) {
        move_drags_.push_back(
            {workspace_.history().state(), panels_.move.kind, std::move(*before)});
    }
    if (move_preview_.dragging()) window_.animate();
}

const Editor::MoveDragStep* Editor::lastMoveDrag() const {
    if (move_drags_.empty()) return nullptr;
    const MoveDragStep& last = move_drags_.back();
    const bool fits = last.kind == panels_.move.kind && last.state == workspace_.history().state();
    return fits ? &last : nullptr;
}

void Editor::cancelMoveDrag() {
    if (move_preview_.cancelDrag(panels_.move) && !move_drags_.empty()) move_drags_.pop_back();
}

bool Editor::undoMoveDrag() {
    if (move_preview_.dragging()) {
        cancelMoveDrag();
        return true;
    }
    const MoveDragStep* last = lastMoveDrag();
    if (last == nullptr) return false;
    panels_.move.options[last->kind] = last->before;
    move_drags_.pop_back();
    return true;
}

void Editor::makeMove() {
    const planning::MoveRequest move = moveOfForm();
    const auto make = [this, move](const SharedMotion& after) {
        motions_.make(move, after, workspace_.shown());
    };
    const SharedMotion& motion = workspace_.state().edits.plan.motion;
    const std::string title = "Replace the camera path?";
    if (!cameraKeys().empty()) {
        questions_.ask(
            {title,
             fmt::format("It has {} key frames. The move can follow them, as keys a second apart, "
                         "or replace them.",
                         cameraKeys().size()),
             {{"Append", [make, motion] { make(motion); }}, {"Replace", [make] { make({}); }}}});
    } else if (motionFile() != nullptr) {
        questions_.ask({title,
                        fmt::format("The move replaces the imported path {}. Undo brings it back.",
                                    motion->name),
                        {{"Replace", [make] { make({}); }}}});
    } else {
        make({});
    }
}

std::string Editor::moveFault(const Error& error) {
    // Errors name the settings as the command line does, separated by commas.
    const auto isSetting = [](const std::string& name) {
        return std::ranges::any_of(planning::moveKinds(), [&](const planning::MoveKind& kind) {
            return std::ranges::find(kind.settings, name, &planning::MoveSetting::name) !=
                   kind.settings.end();
        });
    };
    std::string labels;
    std::string rest = error.where;
    while (!rest.empty()) {
        const std::size_t cut = rest.find(", ");
        const std::string name = rest.substr(0, cut);
        if (!isSetting(name)) return describe(error);
        labels += (labels.empty() ? "" : ", ") + planning::settingLabel(name);
        rest = cut == std::string::npos ? "" : rest.substr(cut + 2);
    }
    return labels.empty() ? error.message : labels + ": " + error.message;
}

void Editor::takeMotion() {
    std::optional<Result<MotionWorker::Outcome>> outcome = motions_.take();
    if (!outcome || !workspace_.isOpen()) return;
    if (!*outcome) {
        const Error& error = outcome->error();
        if (error.code == ErrorCode::Cancelled) return;
        const bool of_move = motions_.source() == MotionWorker::Source::Move;
        questions_.tell({true,
                         "The camera path was not changed",
                         of_move ? moveFault(error) : describe(error),
                         {}});
        return;
    }
    const std::optional<MotionFile> file_before =
        motionFile() != nullptr ? std::optional(*motionFile()) : std::nullopt;
    const bool repaired = (*outcome)->source == MotionWorker::Source::Repair;
    std::optional<KeptPlan> before;
    if (repaired && whyPlanNotCurrent().empty()) {
        before = currentPlan(workspace_, quality_.of(workspace_.shown().plan).get());
        before->name = "Before the repair";
    }
    nlohmann::json operation = motionJson((*outcome)->motion);
    operation["op"] = "set_motion";
    const MotionWorker::Source source = (*outcome)->source;
    const Status done = workspace_.applyAll(nlohmann::json::array({operation}),
                                            stepName(source, (*outcome)->motion.name));
    tellRefusal(done);
    if (!done) return;
    const SharedMotion& motion = workspace_.state().edits.plan.motion;
    if (source == MotionWorker::Source::File) read_motions_.push_back({motion, (*outcome)->file});
    if (repaired && file_before) read_motions_.push_back({motion, *file_before});
    if (source == MotionWorker::Source::Move) {
        made_motion_ = motion;
        move_note_ = (*outcome)->note;
    }
    if (!repaired) return;
    if (plan() != nullptr && playback_.frame() < frameCount()) {
        position_before_repair_ = plan()->trajectory.frames[playback_.frame()].pose.position;
    }
    repaired_motion_ = motion;
    before_repair_ = std::move(before);
    motion_change_ = changeText((*outcome)->change);
    log::info("editor", "camera path: " + motion_change_);
}

}  // namespace dollytrack::editor
