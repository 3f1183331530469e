#include "app/editor/editor.h"

#include "engine/core/text_lists.h"
#include "engine/plan/object_key.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/follow_motion.h"
#include "planning/timing/clip.h"
#include "planning/timing/motion_limits.h"
#include "ui/overlays/steps_overlay.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/edits/edits_panel.h"
#include "ui/panels/plan/metrics_panel.h"
#include "ui/panels/plan/parameters_panel.h"
#include "ui/panels/scene/layers_panel.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/fields/field_editor.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <numbers>

namespace dollytrack::editor {

using ui::Selection;

void Editor::drawPanel(Panel panel) {
    switch (panel) {
        case Panel::Objects:
            return drawObjects();
        case Panel::Layers:
            return drawLayers();
        case Panel::ByHand:
            return drawEdits();
        case Panel::History:
            return drawHistory();
        case Panel::Parameters:
            return drawParameters();
        case Panel::Selection:
            return drawSelection();
        case Panel::Metrics:
            return drawMetrics();
        case Panel::Timeline:
            return drawTimeline();
        case Panel::Algorithm:
            return drawSteps();
        case Panel::Export:
            return drawExport();
        case Panel::Log:
            return drawLog();
    }
}

void Editor::drawDock(DockSide side) {
    docks_.setBadge(panelName(Panel::Log), panels_.log.unseenWarnings(log_));
    docks_.draw(side, [this](const std::string& name) { drawPanel(panelNamed(name)); });
}

void Editor::drawHistory() {
    ui::HistoryView view;
    const std::vector<std::string> names = workspace_.history().names();
    if (workspace_.isOpen()) view.names = &names;
    view.position = workspace_.history().position();
    const ui::HistoryActions actions = ui::drawHistoryPanel(view, panels_.history);
    if (actions.go_to) workspace_.goTo(*actions.go_to);
}

void Editor::drawLog() {
    ui::drawLogPanel(log_, panels_.log);
}

void Editor::drawObjects() {
    const PlanOutcome& shown = workspace_.shown();
    ui::ObjectsView view;
    view.scene = shown.scene.get();
    if (shown.plan && shown.measured) view.captures = &shown.plan->captures;
    view.selected = &selected_.objects();
    view.hidden = &selected_.hidden();
    if (workspace_.isOpen()) view.edits = &workspace_.state().edits;
    const ui::ObjectsActions actions = ui::drawObjectsPanel(view, panels_.objects);
    if (!actions.range.empty()) {
        select(selected_.withObjects(actions.range, actions.add_to_selection));
    } else if (actions.clicked != 0) {
        selectObject(actions.clicked, actions.add_to_selection);
    }
    if (actions.frame != 0) showUnobstructed(selectedBox());
    if (actions.right_clicked != 0) {
        openSelectionMenu(ui::Selection::ofObject(actions.right_clicked));
    }
    if (actions.toggle_hidden != 0) selected_.toggleHidden(actions.toggle_hidden);
    if (actions.toggle_target != 0) {
        apply({{"op", actions.make_target ? "include" : "exclude"},
               {"object", objectKey(*shown.scene, actions.toggle_target)}});
    }
}

void Editor::drawLayers() {
    const PlanOutcome& shown = workspace_.shown();
    ui::LayersView view;
    if (shown.scene) view.room = shown.scene->room_bounds;
    if (shown.scene) view.storeys = static_cast<int>(storeys().size());
    view.has_map = shown.free_space != nullptr;
    if (shown.free_space) view.cell_m = shown.free_space->resolution_m();
    view.has_plan = shown.plan != nullptr;
    view.measured = shown.measured;
    view.has_surface = view.has_plan && shown.plan->surface;
    const BackgroundWorker::State quality = quality_.state();
    view.measuring_quality = quality.busy;
    view.judging_images = !quality.busy && probes_ != nullptr;
    view.quality_fraction = quality.busy ? quality.fraction : probedShare();
    view.has_kept_plan = comparison_.kept() != nullptr;
    view.stepping = step_playback_.shown();
    const int search = layers_.candidateSearch();
    if (shown.plan && search >= 0 &&
        static_cast<std::size_t>(search) < shown.plan->searches.size()) {
        const ViewpointSearch& tried = shown.plan->searches[search];
        for (const Candidate& candidate : tried.candidates) {
            view.candidates_there[static_cast<std::size_t>(candidate.verdict)] = true;
        }
    }
    for (const auto& layer : layers_.layers().layers) view.legends.push_back(layer->legend);
    ui::drawLayersPanel(view, layer_settings_, clip_);
}

void Editor::drawEdits() {
    ui::EditsView view;
    const PlanOutcome& shown = workspace_.shown();
    if (workspace_.isOpen()) view.edits = &workspace_.state().edits;
    view.scene = shown.scene.get();
    view.plan = shown.plan.get();
    view.plan_is_current = workspace_.isOpen() && workspace_.planIsCurrent();
    if (workspace_.isOpen() && parameters_.read(workspace_.state().parameters)) {
        view.min_height_m = parameters_.params().free_space.min_height_m;
        view.max_height_m = parameters_.params().free_space.max_height_m;
    }
    view.new_box = boxInView();
    view.around_selection = boxAroundSelection();
    view.motion = motionView();
    const ui::EditsActions actions = ui::drawEditsPanel(view, panels_.move);
    applyRequest(actions.edit);
    follow(actions.motion);
    if (actions.select) select(*actions.select);
    if (actions.look_through) lookAlongPose(*actions.look_through);
    if (actions.frame) {
        Eigen::AlignedBox3d box;
        for (const Eigen::Vector3d& corner : actions.frame->corners()) box.extend(corner);
        showUnobstructed(box);
    }
}

void Editor::setParameter(const std::string& name) {
    FieldList& fields = parameters_.fields();
    const auto field = std::ranges::find(fields, name, &Field::name);
    workspace_.setParameters(
        toJson(fields), fmt::format("Set {} to {}", ui::readableName(*field), field->valueText()),
        "set " + name);
}

std::map<std::string, std::string, std::less<>> Editor::parameterNotes() {
    std::map<std::string, std::string, std::less<>> notes;
    const PlanOutcome& shown = workspace_.shown();
    const double asked_m = shown.params.free_space.octree_resolution_m;
    if (shown.free_space && shown.free_space->resolution_m() > asked_m) {
        notes["octree_resolution_m"] =
            fmt::format("{:.3g} m is used, as the scene is too large for {:.3g} m",
                        shown.free_space->resolution_m(), asked_m);
    }
    if (workspace_.state().edits.plan.motion) {
        for (std::string& name : planning::withoutEffectOnMotion(parameters_.params())) {
            notes[std::move(name)] = "No effect while a camera path is given";
        }
        return notes;
    }
    if (!workspace_.planIsCurrent() || plan() == nullptr) return notes;
    const std::string_view reason =
        planning::whyFramesWereLeftOut(plan()->trajectory, shown.params.timing);
    if (!reason.empty()) {
        notes["max_frames"] = fmt::format(
            "{} of {} frames are kept, {:.3g}/s on average{}. With keep frame rate none is left "
            "out, but fewer objects are visited.",
            frameCount(), frameCount() + plan()->trajectory.left_out.size(),
            planning::meanFrameRate(plan()->trajectory),
            reason == "max_repeat_rate" ? "; more would exceed max repeat rate" : "");
    }
    return notes;
}

void Editor::drawParameters() {
    if (!workspace_.isOpen()) {
        ImGui::TextDisabled("No scene is open.");
        return;
    }
    if (!parameters_.read(workspace_.state().parameters)) return;
    FieldList& fields = parameters_.fields();
    ui::ParametersView view;
    view.standard = &parameters_.standard();
    view.has_scene = true;
    view.filter = &parameters_.filter;
    view.notes = parameterNotes();
    const ui::ParametersActions actions = ui::drawParametersPanel(view, fields);
    if (actions.reset_all) {
        parameters_.reset();
        workspace_.setParameters(toJson(fields), "Reset all parameters", "");
    } else if (!actions.edited.empty()) {
        setParameter(actions.edited);
    }
    if (actions.finished) workspace_.endMerge();
}

void Editor::drawMetrics() {
    const PlanOutcome& shown = workspace_.shown();
    const BackgroundWorker::State job = workspace_.planning();
    ui::MetricsView view;
    view.plan = shown.plan.get();
    view.measured = shown.measured;
    view.scene = shown.scene.get();
    view.busy = job.busy;
    view.stage = job.stage;
    view.fraction = job.fraction;
    view.last_run_ms = workspace_.lastLatency_ms();
    view.comparison = comparisonView();
    const ui::MetricsActions actions = ui::drawMetricsPanel(view);
    if (actions.select_object != 0) selectObject(actions.select_object, false);
    follow(actions.comparison);
}

void Editor::drawSelection() {
    ui::SelectionView view;
    const PlanOutcome& shown = workspace_.shown();
    view.selection = &selected_.now();
    view.scene = shown.scene.get();
    view.plan = shown.plan.get();
    view.measured = shown.measured;
    if (workspace_.isOpen()) view.edits = &workspace_.state().edits;
    view.free_space = shown.free_space.get();
    view.keys_planned = !passedKeys().empty();
    view.track_time_s = track_time_.now();
    if (selected_.is(Selection::Kind::Object)) {
        view.piece_sizes_m = pieces_.of(shown.scene, selected_.objects().front());
    }
    panels_.selection.show_candidates = layer_settings_.candidates;
    const int object =
        selected_.now().kind == ui::Selection::Kind::Object ? selected_.now().objects.front() : 0;
    if (object != 0) view.remedy = remedies_.state(shown, object);
    const ui::SelectionActions actions = ui::drawSelectionPanel(view, panels_.selection);
    layer_settings_.candidates = panels_.selection.show_candidates;
    if (actions.went_to_s) track_time_.goTo(*actions.went_to_s);
    applyRequest(actions.edit);
    if (actions.frame) showUnobstructed(selectedBox());
    if (actions.go_to_frame >= 0) goToFrame(actions.go_to_frame);
    if (actions.look_through) lookAlongPose(*actions.look_through);
    if (actions.remedy.find) remedies_.find(shown, object);
    if (actions.remedy.cancel) remedies_.cancel();
    if (actions.remedy.select_object) {
        return selectObject(view.remedy.row.remedy->move_object, false);
    }
    if (actions.remedy.apply) {
        tellRefusal(workspace_.applyAll(remedies_.operations(), remedies_.name()));
    }
    if (actions.select) select(*actions.select);
}

void Editor::drawTimeline() {
    drawTracks();
    ui::TimelineView view;
    view.frame = playback_.frame();
    view.playing = playback_.playing();
    if (const Plan* now = plan()) {
        view.frame_count = frameCount();
        view.frame_interval_s = now->trajectory.frame_interval_s;
        view.times_s = &plan_timeline_.times();
        view.keys = &plan_timeline_.keys();
        view.bands = &plan_timeline_.bands();
        view.collisions = &plan_timeline_.collisions();
        view.series = &now->series;
        view.quality = quality_.of(workspace_.shown().plan).get();
        view.earlier = plan_timeline_.measured();
        view.earlier_quality = plan_timeline_.measuredQuality();
        view.measures_quality = plan_timeline_.qualityPending();
        view.target_count = now->capture_metrics.objects;
        const planning::PlanParams& params = workspace_.shown().params;
        view.camera_radius_m = params.camera.camera_radius_m;
        const planning::MotionLimits limits = planning::motionLimits(params.timing);
        view.max_speed_mps = limits.speed_mps;
        view.max_turn_dps = limits.turn_rps * 180.0 / std::numbers::pi;
        view.object_name = [this](int id) { return workspace_.shown().scene->object(id).name; };
        if (const KeptPlan* kept = comparison_.kept()) {
            view.kept_s = durationOf(*kept->trajectory);
            view.kept_text =
                fmt::format("{} frames, {:.1f} s", kept->trajectory->frames.size(), view.kept_s);
        }
    }
    const std::vector<ui::TimelineCameraKey> keys = timelineCameraKeys();
    view.camera_keys = &keys;
    if (selectedKey() != nullptr) view.selected_key = selected_.now().index;
    follow(ui::drawTimelinePanel(view, panels_.timeline));
}

void Editor::drawSteps() {
    ui::StepsView view;
    view.serial = plan_timeline_.serial();
    view.taken = step_playback_.taken();
    view.playing = step_playback_.playing();
    if (plan() != nullptr) {
        view.steps = &plan()->roadmap.steps;
        view.describe = [this](std::size_t i) {
            return ui::describe(*workspace_.shown().scene, *plan(), plan()->roadmap.steps.steps[i]);
        };
    }
    step_playback_.show(true);
    const ui::StepsActions actions = ui::drawStepsPanel(view, panels_.steps);
    const StepPlayback::Next next = [this](std::size_t taken) {
        return ui::nextStop(panels_.steps.rows, taken, 1);
    };
    if (actions.go_to) step_playback_.goTo(*actions.go_to);
    if (actions.toggle_play) step_playback_.toggle(next);
    if (!step_playback_.playing()) return;
    window_.animate();
    step_playback_.advance(ImGui::GetIO().DeltaTime * panels_.steps.per_second, next);
}

void Editor::drawDragStatus() {
    ImGui::TextColored(ui::palette().accent, "%s", gizmo_.text().c_str());
    ui::nameItem("status.drag");
    ImGui::SameLine();
    const char* keys = "   Ctrl: steps   Esc: cancel";
    if (gizmo_.usesKeys()) {
        keys = gizmo_.turning() ? "   0-9 . -: number   Ctrl: steps   Enter: done   Esc: cancel"
                                : "   X Y Z: axis (Shift: plane)   0-9 . -: number (Tab: next)   "
                                  "Ctrl: steps   Enter: done   Esc: cancel";
    }
    ImGui::TextDisabled("%s", keys);
}

void Editor::drawStatus() {
    const BackgroundWorker::State job = workspace_.planning();
    const PlanOutcome& shown = workspace_.shown();
    if (selected_.inLocalView() || clip_.has_box || clip_.hides_above) {
        ImGui::TextColored(ui::palette().accent, selected_.inLocalView()
                                                     ? "Local view (/ shows all)  "
                                                     : "Parts are hidden (see Layers)  ");
        ui::nameItem("status.parts_hidden");
        ImGui::SameLine();
    }
    if (const unsigned unseen = panels_.log.unseenWarnings(log_); unseen > 0) {
        const std::string text = fmt::format("{} warning{}", unseen, unseen == 1 ? "" : "s");
        if (ui::link(text, "status.warnings", "Show the log")) {
            docks_.open(panelName(Panel::Log));
        }
        ImGui::SameLine();
    }
    if (gizmo_.dragging()) {
        drawDragStatus();
    } else if (panels_.viewport.box_select) {
        ImGui::TextColored(ui::palette().accent, "Drag a box around objects");
        ImGui::SameLine();
        ImGui::TextDisabled("   Shift: add   Ctrl: take out   Esc: cancel");
    } else if (!refused_key_.empty()) {
        ImGui::TextColored(ui::palette().accent, "%s", refused_key_.c_str());
        ui::nameItem("status.refused_key");
    } else if (job.busy) {
        ImGui::ProgressBar(static_cast<float>(job.fraction),
                           {ui::scaled(120), ImGui::GetTextLineHeight()}, "");
        ImGui::SameLine();
        ImGui::Text("planning: %s", job.stage.c_str());
        ImGui::SameLine();
        if (ui::link("Stop", "status.plan.stop")) workspace_.stopPlanning();
    } else if (workspace_.planningStopped()) {
        ImGui::TextDisabled("planning was stopped");
        ImGui::SameLine();
        if (ui::link("Plan", "status.plan.start")) workspace_.startPlanning();
    } else if (const std::string error = workspace_.planError(); !error.empty()) {
        ImGui::TextColored(ui::palette().bad, "%s: %s", shown.outdated ? "No new plan" : "No plan",
                           error.c_str());
    } else if (shown.plan && shown.measured) {
        drawPlanStatus(*shown.plan);
    } else {
        ImGui::TextDisabled("%s", workspace_.isOpen() ? "" : "No scene is open.");
    }
    drawSceneStatus();
}

void Editor::drawPlanStatus(const Plan& plan) {
    const CaptureMetrics& capture = plan.capture_metrics;
    const auto& frames = plan.trajectory.frames;
    const auto keys =
        std::ranges::count_if(frames, [](const auto& frame) { return frame.position_point >= 0; });
    const double seconds = durationOf(plan.trajectory);
    const std::size_t paths = plan.smooth_paths.size();
    ImGui::Text("%s in %s%s, %d of %d targets captured",
                counted(frames.size(), "frame", "frames").c_str(),
                ui::durationText(seconds).c_str(),
                paths > 1 ? fmt::format(" on {} separate paths", paths).c_str() : "",
                capture.captured, capture.objects);
    ui::nameItem("status.plan");
    ui::tooltip(
        fmt::format("Targets that fill at least 5 % of the image in one of the frames: {}. Frames "
                    "at position points: {}.{} The Metrics panel tells more.",
                    capture.well_captured, keys,
                    paths > 1 ? " No collision-free path connects all views: the camera jumps from "
                                "one path to the next."
                              : ""));
    drawLightStatus();
}

void Editor::drawLightStatus() {
    const LightWorker& light = workspace_.lighter();
    if (drawing_.finalLight() || (light.isFinal() && !light.state().busy)) return;
    ImGui::SameLine();
    if (light.stopped()) {
        ImGui::TextDisabled(light.light() ? "   coarse light" : "   without light");
        ImGui::SameLine();
        if (ui::link("Compute", "status.light.start")) workspace_.startLight();
        return;
    }
    ImGui::TextDisabled("   computing light %.0f %%", 100.0 * light.state().fraction);
    ui::nameItem("status.light");
    ui::tooltip(
        "Light as in exports. Until it is ready, the scene has coarser or uniform light. Computing "
        "pauses while planning.");
    ImGui::SameLine();
    if (ui::link("Stop", "status.light.stop")) workspace_.stopLight();
}

void Editor::drawSceneStatus() {
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.scene) return;
    const auto targets = std::ranges::count(shown.scene->objects, Role::Target, &Object::role);
    const std::size_t chosen = selected_.objects().size();
    std::string text = fmt::format("{} objects, {} targets", shown.scene->objects.size(), targets);
    if (chosen > 1) text = fmt::format("{} selected   ", chosen) + text;
    ImGui::SameLine();
    const float room = ImGui::GetContentRegionAvail().x;
    text = ui::cutToWidth(text, room);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - ImGui::CalcTextSize(text.c_str()).x);
    ImGui::TextDisabled("%s", text.c_str());
    ui::nameItem("status.scene");
    ui::tooltip(
        fmt::format("{:L} triangles; one unit of the scene file is {:g} m\n"
                    "drawn by {} in {:.0f} ms, the window in {:.0f} ms",
                    shown.scene->triangles.size(), shown.scene->report.unit_m,
                    drawing_.rendererName(), drawing_.view().milliseconds, window_.lastFrame_ms()));
}

}  // namespace dollytrack::editor
