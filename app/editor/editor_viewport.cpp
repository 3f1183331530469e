#include "app/editor/editor.h"

#include "engine/core/text_lists.h"
#include "engine/geometry/ray_caster.h"
#include "engine/plan/object_key.h"
#include "planning/free_space/free_space.h"
#include "render/draw/storey_cutaway.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/scene/layers_panel.h"
#include "ui/theme.h"
#include "ui/viewport/legend_view.h"
#include "ui/widgets/note_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dollytrack::editor {

using ui::Selection;

namespace {

// Marks have full size from this scale on; when smaller, they would cover the rooms and each other.
constexpr double kFullSizeMetre_px = 80.0;
constexpr double kSmallestMarks = 0.6;

/// The import settings in use: "1 unit = 4.1 m, z up".
std::string importText(const ImportReport& report) {
    ImportProposal as_read;
    as_read.unit_m = report.unit_m;
    as_read.up_axis = parseUpAxis(report.up_axis);
    return settingsText(as_read);
}

}  // namespace

const std::vector<render::StoreyView>& Editor::storeys() const {
    const PlanOutcome& shown = workspace_.shown();
    if (storeys_of_scene_ != shown.scene || storeys_of_plan_ != shown.plan) {
        storeys_of_scene_ = shown.scene;
        storeys_of_plan_ = shown.plan;
        storeys_ =
            render::storeysOf(*shown.scene, shown.plan ? std::span(shown.plan->rooms)
                                                       : std::span<const Eigen::AlignedBox3d>());
    }
    return storeys_;
}

render::View Editor::viewportView(const ui::ViewerCamera& camera) const {
    const PlanOutcome& shown = workspace_.shown();
    render::View view;
    if (through_camera_ && playback_.frame() < frameCount()) {
        CameraParams planned = shown.params.camera;
        planned.width_px = pane_.width;
        planned.height_px = pane_.height;
        view.intrinsics = makeIntrinsics(planned);
        view.pose = plan()->trajectory.frames[playback_.frame()].pose;
        view.near_m = planned.near_m;
    } else {
        view = camera.view(pane_.width, pane_.height);
    }
    view.hidden = selected_.leftOut();
    if (!through_camera_) view.clip_box = clip_.shown();
    const bool dark = settings_.theme == ui::ThemeKind::Dark;
    view.backdrop =
        dark ? Eigen::Vector3f(0.125F, 0.137F, 0.153F) : Eigen::Vector3f(0.90F, 0.905F, 0.91F);
    if (through_camera_ || !layer_settings_.ceiling_cut) return view;

    const std::span<const Eigen::AlignedBox3d> rooms =
        shown.plan ? std::span(shown.plan->rooms) : std::span<const Eigen::AlignedBox3d>();
    const Eigen::AlignedBox3d building = render::buildingOf(*shown.scene, rooms);
    if (building.isEmpty() || building.contains(camera.pose().position)) return view;
    const std::vector<render::StoreyView>& all = storeys();
    const bool is_there = layer_settings_.storey > 0 &&
                          static_cast<std::size_t>(layer_settings_.storey) <= all.size();
    const render::StoreyView& storey = is_there ? all[layer_settings_.storey - 1] : all.back();
    const std::vector<bool> covers = render::hiddenFor(*shown.scene, storey);
    for (std::size_t i = 0; i < std::min(covers.size(), view.hidden.size()); ++i) {
        if (covers[i]) view.hidden[i] = true;
    }
    const Eigen::Vector3d way = camera.towardsViewer();
    if (way.z() < -0.1) return view;
    // In a view straight down all walls stay; the lower the view, the stronger the cut.
    const Eigen::Vector3d level(way.x(), way.y(), 0.0);
    view.structure_cut = render::cutTowards(
        all.size() > 1 ? render::withinStorey(building, storey) : building, storey.floor_z,
        storey.ceiling_z, level * std::min(1.0, 1.6 * (1.0 - way.z()) + 0.2));
    return view;
}

Pose Editor::viewPose() const {
    const bool through_frame = through_camera_ && playback_.frame() < frameCount();
    return through_frame ? plan()->trajectory.frames[playback_.frame()].pose
                         : panels_.viewport.camera.pose();
}

std::string Editor::viewName() const {
    if (through_camera_) return "Camera";
    const ui::ViewerCamera& camera = panels_.viewport.camera;
    return fmt::format("{} {}{}", camera.axisName(),
                       camera.orthographic ? "Orthographic" : "Perspective",
                       selected_.inLocalView() ? " (local view)" : "");
}

void Editor::requestLayers() {
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.scene) return;
    LayersRequest request;
    request.scene = shown.scene;
    request.plan = shown.plan;
    addComparison(request);
    request.free_space = shown.free_space;
    request.camera = shown.params.camera;
    request.settings = layer_settings_;
    request.cone_half_angle_deg = shown.params.viewpoints.cone_half_angle_deg;
    request.stepping = step_playback_.shown();
    request.selection = selected_.now();
    for (const ui::MovedObject& one : movedObjects()) request.moved.push_back(one.object_id);
    for (const int id : selected_.objects()) {
        if (selected_.isLeftOut(id)) request.left_out.push_back(id);
    }
    request.no_go = workspace_.state().edits.plan.no_go;
    request.regions = workspace_.state().edits.plan.regions;
    request.motion = workspace_.state().edits.plan.motion;
    request.keys_planned = !passedKeys().empty();
    request.step = step_playback_.taken();
    request.frame = through_camera_ ? -1 : playback_.frame();
    if (selected_.inLocalView()) {
        // Only the points and candidates of its objects remain.
        ui::LayerSettings& on = request.settings;
        on.free_space = on.no_go_boxes = on.roadmap = on.trajectory = on.surface = false;
        on.quality = on.kept_plan = false;
        request.stepping = false;
        request.frame = -1;
        request.local = selected_.localObjects();
    }
    const ui::ViewerCamera& camera = panels_.viewport.camera;
    // A parallel projection has no eye position.
    request.in_cone = through_camera_
                          ? playback_.frame() < frameCount() &&
                                looksFromCone(request, viewportView(camera).pose.position)
                          : !camera.orthographic && looksFromCone(request, camera.pose().position);
    layers_.request(request);
}

double Editor::overlayScale() const {
    const double screen = window_.contentScale() * settings_.zoom;
    if (through_camera_) return screen;
    const ui::ViewerCamera& camera = panels_.viewport.camera;
    const double half_width_m =
        camera.distance * std::tan(camera.hfov_deg * std::numbers::pi / 360.0);
    const double metre_px = pane_.width / (2.0 * half_width_m) / screen;
    return screen * std::clamp(metre_px / kFullSizeMetre_px, kSmallestMarks, 1.0);
}

void Editor::requestPicture() {
    if (!workspace_.shown().scene || !scene_sync_.isSent() || pane_.width < 16) return;
    if (scene_sync_.takeFirstView()) {
        panels_.viewport.camera.frame(workspace_.shown().scene->room_bounds,
                                      static_cast<double>(pane_.width) / pane_.height);
    }
    ui::ViewRequest request;
    request.view = viewportView(panels_.viewport.camera);
    request.pixel_scale = overlayScale();
    request.moved = movedObjects();
    for (const auto& layer : layers_.layers().layers) {
        request.layers.push_back({std::shared_ptr<const render::Overlay>(layer, &layer->overlay)});
    }
    drawing_.requestView(std::move(request));
}

std::optional<Pose> Editor::previewPose() const {
    if (plan() == nullptr) return std::nullopt;
    if (gizmo_.draggedPose()) return gizmo_.draggedPose();
    const PositionPoint* point = selected_.positionPoint(plan());
    if (panels_.preview.shows_selection && point != nullptr) return point->pose;
    if (playback_.frame() >= frameCount()) return std::nullopt;
    return plan()->trajectory.frames[playback_.frame()].pose;
}

void Editor::requestPreview() {
    const std::optional<Pose> pose = previewPose();
    if (!pose || !scene_sync_.isSent() || !panels_.preview.open) return;
    const CameraParams& camera = workspace_.shown().params.camera;
    render::View view;
    view.intrinsics = makeIntrinsics(camera);
    view.pose = *pose;
    view.near_m = camera.near_m;
    // At rest it is rendered as for export; antialiasing and reflections take several times as
    // long.
    const bool moves = playback_.playing() || gizmo_.draggedPose();
    if (!moves) {
        view.antialias = workspace_.shown().params.picture.antialias;
        view.reflections = workspace_.shown().params.picture.reflections;
    }
    const double time_s = playback_.frame() < frameCount()
                              ? plan()->trajectory.frames[playback_.frame()].time_s
                              : 0.0;
    drawing_.requestPreview(view, playback_.frame(), time_s, panels_.preview.modality);
}

std::optional<ui::GizmoView> Editor::gizmoView() {
    if (!workspace_.isOpen() || through_camera_) return std::nullopt;
    const PlanEdits& edits = workspace_.state().edits.plan;
    const PositionPoint* point = selected_.positionPoint(plan());
    const NoGoBox* no_go = selected_.noGoBox(edits.no_go);
    const Region* region = selected_.region(edits.regions);
    ui::GizmoView view;
    view.view = drawing_.view().view;
    view.origin = pane_.origin;
    view.hovered = pane_.hovered && !preview_hovered_ && !panels_.legend.hovered &&
                   !panels_.viewport.box_select;
    const MotionKey* key = selectedKey();
    view.turns = point != nullptr || key != nullptr;
    if (const std::vector<int> objects = movableObjects(); !objects.empty()) {
        const auto is_left_out = [&](int id) { return selected_.isLeftOut(id); };
        if (std::ranges::any_of(objects, is_left_out)) return std::nullopt;
        view.pose = poseOfObjects(objects);
        view.turns = true;
        view.tilts = false;
        if (objects.size() == 1) view.heading_rad = objectBox(objects[0]).yaw;
    } else if (no_go != nullptr) {
        view.pose.position = no_go->box.center;
        view.heading_rad = no_go->box.yaw;
    } else if (region != nullptr) {
        view.pose.position = region->box.center;
        view.heading_rad = region->box.yaw;
    } else if (point != nullptr || key != nullptr) {
        view.pose = point != nullptr ? point->pose : key->pose;
        const Eigen::Vector3d ahead = view.pose.forward();
        view.heading_rad = std::atan2(ahead.y(), ahead.x());
    } else {
        return std::nullopt;
    }
    return view;
}

void Editor::editWithGizmo() {
    const std::optional<ui::GizmoView> handles = gizmoView();
    if (!handles) {
        if (gizmo_.dragging()) dropGizmo();
        return;
    }
    const ui::GizmoView& view = *handles;
    // A click may begin a drag; one that keys begin is noted there.
    if (!gizmo_.dragging() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        history_before_drag_ = workspace_.history().history();
    }
    // A refusal ends typing, since its message needs the keyboard.
    const bool cancels = ImGui::IsMouseClicked(ImGuiMouseButton_Right) ||
                         (gizmo_.usesKeys() && questions_.waiting());
    if (gizmo_.dragging() && cancels) cancelDrag();
    if (const std::vector<int> objects = movableObjects(); !objects.empty()) {
        moveWithGizmo(view, objects);
        return;
    }
    const PositionPoint* point = selected_.positionPoint(plan());
    const PlanEdits& edits = workspace_.state().edits.plan;
    const NoGoBox* no_go = selected_.noGoBox(edits.no_go);
    const Region* region = selected_.region(edits.regions);
    if (no_go != nullptr || region != nullptr) {
        const std::string op = no_go ? "move_no_go" : "change_region";
        const std::string name = no_go ? no_go->name : region->name;
        const ui::GizmoActions actions = gizmo_.draw(view);
        if (actions.changed) {
            apply({{"op", op}, {"name", name}, {"center", ui::pointJson(actions.pose.position)}},
                  "gizmo " + op + name);
        }
        if (actions.finished) finishDrag();
        return;
    }
    const std::optional<Pose> moved = gizmo_.drawPoint(view);
    if (gizmo_.draggedPose()) window_.animate();
    if (!moved) return;
    // A drag becomes one edit when it ends; meanwhile only the preview follows.
    if (point == nullptr) return moveSelectedKey(*moved);
    const PositionPoint& here = *point;
    const nlohmann::json position = ui::pointJson(moved->position);
    const nlohmann::json turn = ui::turnJson(moved->rotation);
    const auto& pinned = workspace_.shown().state->edits.plan.pinned;
    if (here.pin >= 0 && static_cast<std::size_t>(here.pin) < pinned.size()) {
        apply({{"op", "move_point"},
               {"point", pinned[here.pin].name},
               {"position", position},
               {"quaternion_xyzw", turn}});
    } else {
        const auto& objects = plan()->observation_points[here.observation_point].objects;
        apply({{"op", "pin"},
               {"objects", objectKeys(*workspace_.shown().scene, objects)},
               {"position", position},
               {"quaternion_xyzw", turn}});
    }
}

bool Editor::previewIsDocked() const {
    const ui::PreviewState& preview = panels_.preview;
    return workspace_.isOpen() && preview.docked && preview.open && !preview.full &&
           docks_.places().isVisible(DockSide::Bottom);
}

float Editor::previewWidth(float height, float window_width) const {
    const CameraParams& camera = workspace_.shown().params.camera;
    const float picture = height - ImGui::GetFrameHeight() - ui::scaled(10);
    const float aspect =
        static_cast<float>(camera.width_px) / static_cast<float>(std::max(camera.height_px, 1));
    // At least its title bar, and at most a third of the window.
    return std::max(std::min(picture * aspect, window_width / 3.0F), ui::scaled(312));
}

void Editor::drawPreview() {
    const bool has = plan() != nullptr && frameCount() > 0;
    ui::PreviewView view;
    view.image = &drawing_.preview();
    view.scene = workspace_.shown().scene.get();
    const ImVec2 low = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    view.docked = previewIsDocked();
    // The full preview covers the whole viewport.
    const float margin = view.docked || panels_.preview.full ? 0.0F : ui::scaled(8);
    view.low = {low.x + margin, low.y + margin};
    view.high = {low.x + size.x - margin, low.y + size.y - margin};
    view.busy = drawing_.busy();
    view.point_selected = selected_.is(Selection::Kind::PositionPoint);
    view.what = panels_.preview.shows_selection && view.point_selected
                    ? fmt::format("point {}", selected_.now().index)
                    : fmt::format("frame {}", playback_.frame());
    if (!has) view.why_not = "There is no trajectory.";
    const ui::PreviewActions actions = ui::drawPreviewPanel(view, panels_.preview);
    preview_hovered_ = actions.hovered && !view.docked;
    if (actions.save_png) {
        picture_to_save_ = drawing_.preview();
        askForFile("preview.png");
    }
}

void Editor::drawLegend() {
    std::vector<ui::Legend> legends;
    for (const auto& layer : layers_.layers().layers) {
        if (!layer->legend.entries.empty() || layer->legend.scale) legends.push_back(layer->legend);
    }
    panels_.legend.hovered = false;
    if (legends.empty() || through_camera_) return;
    const float margin = ui::scaled(10);
    const float below_name = ImGui::GetTextLineHeight() + ui::scaled(4);
    const ImVec2 low(static_cast<float>(pane_.origin.x()) + margin,
                     static_cast<float>(pane_.origin.y()) + margin + below_name);
    // In a small viewport the legend would hide much of the scene.
    const bool has_room = static_cast<float>(pane_.width) > ui::scaled(800) &&
                          static_cast<float>(pane_.height) > ui::scaled(440);
    const bool open = settings_.layout.show_legend.value_or(has_room);
    panels_.legend.open = open;
    ui::drawLegendBox(legends, low,
                      {static_cast<float>(pane_.width) - 2 * margin,
                       static_cast<float>(pane_.height) - 2 * margin - below_name},
                      panels_.legend);
    if (panels_.legend.open != open) settings_.layout.show_legend = panels_.legend.open;
}

void Editor::drawImportBar() {
    if (!workspace_.isOpen() || workspace_.loading().busy || import_bar_dismissed_) return;
    if (workspace_.previousImport()) {
        const int pressed = ui::drawNoteBar(
            "import_changed",
            "The scene was read again with " + importText(workspace_.importReport()) + ".",
            {{"Undo", "Read it as before"}, {"Keep", "Hide this message"}},
            ui::NoteBarKind::Confirmation);
        if (pressed == 0) workspace_.revertImport();
        if (pressed == 1) import_bar_dismissed_ = true;
        return;
    }
    const ImportProposal& proposal = workspace_.proposal();
    if (proposal.isEmpty()) return;
    const std::string& up = proposal.up_doubt;
    const std::string& unit = proposal.unit_doubt;
    std::string text = up + (up.empty() || unit.empty() ? "" : "; ") + unit;
    std::vector<ui::NoteBarButton> buttons;
    if (proposal.hasSettings()) {
        buttons.push_back({"Read with " + settingsText(proposal),
                           "Reload the scene file with this setting; can be undone"});
    } else {
        text += "; if it is wrong, choose another in the menu File > Unit of length";
    }
    buttons.push_back({"Keep",
                       "Keep the settings in use, and do not ask again: they are stored in the "
                       "project"});
    const int pressed = ui::drawNoteBar("import_doubt", text, buttons);
    if (pressed < 0) return;
    if (pressed == 0 && proposal.hasSettings()) return workspace_.applyProposal();
    import_bar_dismissed_ = true;
    import_kept_here_ = true;
    settings_.addSeen(kImportKept + workspace_.sceneFile().string());
    workspace_.keepImport("Keep " + importText(workspace_.importReport()));
}

void Editor::drawTextureBar() {
    if (!textures_note_ || !workspace_.isOpen()) return;
    const std::vector<std::string>& missing = workspace_.importReport().textures_missing;
    const std::string count = counted(missing.size(), "texture is missing", "textures are missing");
    const int pressed = ui::drawNoteBar(
        "textures_missing", count + "; those surfaces have a plain colour.",
        {{"Details\u2026", "Name the missing textures"}, {"Hide", "Hide this message"}});
    if (pressed == 1) {
        textures_note_ = false;
        settings_.addSeen(missing_textures_note_);
    }
    if (pressed != 0) return;
    constexpr std::size_t kMostNamed = 20;
    std::string text;
    for (std::size_t i = 0; i < std::min(missing.size(), kMostNamed); ++i)
        text += missing[i] + "\n";
    if (missing.size() > kMostNamed)
        text += fmt::format("and {} more\n", missing.size() - kMostNamed);
    questions_.tell({false, count, text + "Put them beside the scene file and open it again.", {}});
}

void Editor::drawSavedPathBar() {
    if (saved_path_.empty()) return;
    std::string text = "The camera path was saved as " + saved_path_.string();
    if (plan() != nullptr && plan()->smooth_paths.size() > 1) {
        text += fmt::format(". It has {} separate paths; the camera jumps from one to the next.",
                            plan()->smooth_paths.size());
    }
    const int pressed = ui::drawNoteBar("path_saved", text, {{"Hide", "Hide this message"}},
                                        ui::NoteBarKind::Confirmation);
    if (pressed == 0) saved_path_.clear();
}

void Editor::drawBars() {
    drawImportBar();
    drawSavedPathBar();
    drawKeyBar();
    drawTextureBar();
    if (!workspace_.fileChanged()) return;
    const std::filesystem::path file = workspace_.path();
    const int pressed = ui::drawNoteBar(
        "file_changed", "Changed by another program: " + file.string(),
        {{"Reload", "Reload the file from disk"},
         {"Keep mine", "Keep the open version; saving asks before overwriting the file"}});
    if (pressed == 1) workspace_.dismissFileChange();
    if (pressed != 0) return;
    if (!workspace_.unsaved()) return workspace_.open(file);
    questions_.ask({"Reload " + file.filename().string() + "?",
                    "Changes made here since it was opened or saved are lost.",
                    {{"Reload", [this, file] { workspace_.open(file); }}}});
}

void Editor::drawCentre() {
    drawBars();
    const BackgroundWorker::State loading = workspace_.loading();
    if (!workspace_.isOpen() && !loading.busy) return drawStart();
    panels_.start.frames = 0;
    recent_.hide();
    ui::ViewportView view;
    view.image = scene_sync_.isSent() ? &drawing_.view() : nullptr;
    if (loading.busy) {
        view.message = fmt::format("Reading … {:.0f} %  {}   (Esc stops)", 100.0 * loading.fraction,
                                   loading.stage);
    } else if (view.image == nullptr || view.image->serial == 0 ||
               !workspace_.shown().hasObjectsOf(view.image->geometry)) {
        view.image = nullptr;
        const bool failed = !workspace_.shown().scene && !workspace_.planError().empty();
        view.message = failed ? "The scene cannot be shown: " + workspace_.planError()
                              : "Preparing the scene …";
    } else {
        has_picture_ = true;
    }
    if (workspace_.shown().outdated)
        view.remark = "Previous plan: planning with these parameters failed";
    view.locked = through_camera_;
    view.name = viewName();
    if (through_camera_) {
        const CameraParams& camera = workspace_.shown().params.camera;
        view.aspect = static_cast<double>(camera.width_px) / camera.height_px;
    }
    // Computed for the current mouse position, which may differ from that of the last frame.
    const std::optional<ui::GizmoView> handles = gizmoView();
    const std::optional<ui::GizmoView> clip = clipView();
    const bool box = panels_.viewport.box_select;  // takes the mouse from all handles
    view.on_handle =
        !box &&
        ((handles && gizmo_.takesMouse(*handles)) || move_preview_.takesMouse(handleView()) ||
         (clip && (clip_handles_.dragged >= 0 || ui::isOnClipHandle(*clip, clip_.box))));
    view.covered =
        preview_hovered_ || panels_.legend.hovered || panels_.preview.full || gizmo_.usesKeys();
    pane_ = ui::drawViewport(view, panels_.viewport);
    if (pane_.camera_moved) window_.animate();
    if (pane_.unlock) leaveCameraView();
    if (!workspace_.isOpen()) return;
    if (pane_.clicked) clickAt(*pane_.clicked, pane_.add_to_selection, pane_.list);
    if (pane_.right_clicked && workspace_.shown().hasObjectsOf(drawing_.view().geometry)) {
        const std::vector<ui::Selection> found = underCursor(*pane_.right_clicked);
        openSelectionMenu(found.empty() ? ui::Selection{} : found.front());
    }
    if (pane_.box) {
        selectInBox(*pane_.box, pane_.add_to_selection, pane_.remove_from_selection);
    }
    if (pane_.double_clicked && !selectedBox().isEmpty()) {
        bringIntoView(selectedBox());
    }
    // Before the gizmo: a click that confirms a move must not grab a handle.
    drawClip();
    drawMove();
    editWithGizmo();
    drawPickList();
    drawSelectionMenu();
    if (!panels_.preview.full) drawLegend();
    drawFrameTip();
    preview_hovered_ = false;
    if (!previewIsDocked()) drawPreview();
}

}  // namespace dollytrack::editor
