#include "app/editor/editor.h"

#include "engine/core/log.h"
#include "engine/geometry/ray_caster.h"
#include "ui/panels/timeline_data.h"
#include "ui/theme.h"
#include "ui/widgets/splitter.h"

#include <imgui.h>

#include <algorithm>

namespace dollytrack::editor {
namespace {

/// The position point of an observation point; -1: it has none.
int positionPointFor(const Plan& plan, int observation_point) {
    for (std::size_t i = 0; i < plan.position_points.size(); ++i) {
        if (plan.position_points[i].observation_point == observation_point) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

constexpr ImGuiWindowFlags kPart = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus;

void beginPart(const char* name, ImVec2 at, ImVec2 size, ImGuiWindowFlags more = 0) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin(name, nullptr, kPart | more);
}

}  // namespace

Editor::Editor(Window& window, std::unique_ptr<gl::Context> drawing, ui::LogBook& log,
               EditorSettings settings)
    : window_(window),
      log_(log),
      settings_(std::move(settings)),
      workspace_(&Window::wake),
      autosave_(&Window::wake),
      drawing_(std::move(drawing), &Window::wake),
      layers_(&Window::wake),
      sheet_(&Window::wake),
      files_(&Window::wake),
      draft_fields_(planning::listFields(draft_)),
      standard_fields_(planning::listFields(standard_)),
      questions_(workspace_, doors()),
      pictures_(&Window::wake) {
    ui::loadFonts(window_.contentScale() * settings_.zoom);
    setTheme();
    addCommands();
    makeExportQueue();
    for (const Field& field : standard_fields_) {
        palette_parameters_.push_back({field.name, std::string(field.text())});
    }
}

Editor::~Editor() {
    settings_.window = window_.settings();
    if (const Status saved = saveSettings(settings_); !saved) {
        log::warn("editor", describe(saved.error()));
    }
}

void Editor::setTheme() {
    ui::applyTheme(settings_.theme, window_.contentScale() * settings_.zoom);
}

void Editor::refreshScene() {
    if (workspace_.takeOpened()) {
        selection_ = {};
        hidden_.clear();
        frame_ = 0;
        step_ = 0;
        playing_ = false;
        through_camera_ = false;
        scene_sent_ = false;
        scene_framed_ = false;
        drawn_geometry_ = 0;
        questions_.forgetProject();
        // The copy was of the project before.
        autosave_.discard();
        autosave_.replaces(workspace_.restoredFrom());
        dropGizmo();
        if (!workspace_.isOpen()) {
            drawing_.setScene(nullptr, nullptr, 0);
        } else {
            settings_.addRecent(workspace_.path().empty() ? workspace_.sceneFile()
                                                          : workspace_.path());
        }
    }
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.scene) return;
    if (shown.plan.get() != plan_seen_) {
        plan_seen_ = shown.plan.get();
        ++plan_serial_;
        timeline_keys_.clear();
        timeline_bands_.clear();
        if (shown.plan) {
            timeline_keys_ = ui::timelineKeys(*shown.scene, *shown.plan);
            timeline_bands_ = ui::timelineBands(*shown.plan);
            step_ = std::min(step_, shown.plan->roadmap.steps.steps.size());
        }
        frame_ = std::clamp(frame_, 0, std::max(frameCount() - 1, 0));
        // Indices into the plan before mean nothing in this one.
        if (selection_.objects.empty() && selection_.kind != ui::Selection::Kind::Voxel &&
            selection_.kind != ui::Selection::Kind::NoGoBox && !gizmo_pose_) {
            keepSelection();
        }
    }
    const auto light = workspace_.light();
    if (scene_sent_ && drawn_scene_ == shown.scene.get() && drawn_light_ == light.get()) return;
    if (drawn_geometry_ != shown.geometry) {
        hidden_.assign(shown.scene->objects.size() + 1, false);
        std::erase_if(selection_.objects, [&](int id) {
            return static_cast<std::size_t>(id) > shown.scene->objects.size();
        });
        if (selection_.objects.empty()) selection_ = {};
    }
    drawing_.setScene(shown.scene, light, shown.geometry);
    drawn_geometry_ = shown.geometry;
    drawn_scene_ = shown.scene.get();
    drawn_light_ = light.get();
    scene_sent_ = true;
}

void Editor::play() {
    if (!playing_ || plan() == nullptr || frameCount() < 2) {
        playing_ = false;
        return;
    }
    window_.animate();
    played_s_ += ImGui::GetIO().DeltaTime * timeline_.speed;
    const double interval = plan()->trajectory.frame_interval_s;
    const int ahead = static_cast<int>(played_s_ / interval);
    if (ahead == 0) return;
    played_s_ -= ahead * interval;
    int next = frame_ + ahead;
    if (next >= frameCount()) {
        if (timeline_.loop) {
            next %= frameCount();
        } else {
            next = frameCount() - 1;
            playing_ = false;
        }
    }
    frame_ = next;
}

bool Editor::frame() {
    for (const std::string& path : window_.takeDroppedPaths()) openAfterAsking(path);
    if (window_.takeCloseRequest()) commands_.find("file.quit")->run();
    if (window_.takeScaleChange()) {
        setTheme();
        window_.requestFonts(window_.contentScale() * settings_.zoom);
    }
    workspace_.poll();
    layers_.poll();
    refreshScene();
    play();
    if (!files_.isOpen() && !palette_.open && !help_.open && !sheet_.isOpen() &&
        !questions_.waiting()) {
        commands_.runShortcuts();
        runKeypad();
    }
    drawMenus();
    arrange();
    drawDialogs();
    requestLayers();
    requestPicture();
    requestPreview();
    autosave();
    window_.setTitle(workspace_.title());
    return !quitting_;
}

void Editor::arrange() {
    const ImGuiViewport* screen = ImGui::GetMainViewport();
    const ImVec2 low = screen->WorkPos;
    const ImVec2 size = screen->WorkSize;
    Layout& layout = settings_.layout;
    const float scale = ui::scaled(1.0F);
    const float status = ImGui::GetFrameHeight() + ui::scaled(6);
    // The viewport keeps a useful size in a small window.
    const float most_side = std::max(0.5F * (size.x / scale - 320.0F), 180.0F);
    const float most_bottom = std::max(size.y / scale - 300.0F, 120.0F);
    layout.left = std::clamp(layout.left, 180.0F, most_side);
    layout.right = std::clamp(layout.right, 180.0F, most_side);
    layout.bottom = std::clamp(layout.bottom, 110.0F, most_bottom);
    const float left = layout.show_left ? scale * layout.left : 0.0F;
    const float right = layout.show_right ? scale * layout.right : 0.0F;
    const float bottom = layout.show_bottom ? scale * layout.bottom : 0.0F;
    const float middle = size.y - status - bottom;
    if (layout.show_left) {
        beginPart("left", low, {left, middle});
        drawLeft();
        ImGui::End();
    }
    if (layout.show_right) {
        beginPart("right", {low.x + size.x - right, low.y}, {right, middle});
        drawRight();
        ImGui::End();
    }
    if (!layout.show_bottom) stepping_ = false;
    if (layout.show_bottom) {
        beginPart("bottom", {low.x, low.y + middle}, {size.x, bottom});
        drawBottom();
        ImGui::End();
    }
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    beginPart("centre", {low.x + left, low.y}, {size.x - left - right, middle},
              ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    drawCentre();
    ImGui::End();
    beginPart("status", {low.x, low.y + size.y - status}, {size.x, status},
              ImGuiWindowFlags_NoScrollbar);
    drawStatus();
    ImGui::End();
    const float grip = ui::scaled(3);
    const auto drag = [&](const char* name, ImVec2 from, ImVec2 to, bool vertical, float sign,
                          float& length, float least, float most) {
        float px = scale * length;
        ui::splitter(name, from, to, vertical, sign, px, scale * least, scale * most);
        length = px / scale;
    };
    if (layout.show_left) {
        drag("splitter.left", {low.x + left - grip, low.y}, {low.x + left + grip, low.y + middle},
             true, 1.0F, layout.left, 180, most_side);
    }
    if (layout.show_right) {
        const float at = low.x + size.x - right;
        drag("splitter.right", {at - grip, low.y}, {at + grip, low.y + middle}, true, -1.0F,
             layout.right, 180, most_side);
    }
    if (layout.show_bottom) {
        drag("splitter.bottom", {low.x, low.y + middle - grip},
             {low.x + size.x, low.y + middle + grip}, false, -1.0F, layout.bottom, 110,
             most_bottom);
    }
}

void Editor::autosave() {
    if (!workspace_.isOpen()) return;
    const CommandStack::State& state = workspace_.history().state();
    if (!workspace_.unsaved()) {
        autosave_.discard();
    } else if (autosave_.isDue(state)) {
        autosave_.store(state, workspace_.snapshot(false),
                        {workspace_.path(), workspace_.fileContent()});
    }
}

void Editor::apply(const nlohmann::json& operation, const std::string& merge_key) {
    if (const Status done = workspace_.apply(operation, merge_key); !done) {
        questions_.tell({true, "That cannot be done", describe(done.error()), {}});
    }
}

void Editor::applyRequest(const ui::EditRequest& request) {
    if (request.asks()) apply(request.operation, request.merge_key);
    if (request.ends_merge) workspace_.endMerge();
}

void Editor::dropGizmo() {
    if (gizmo_.dragged != ui::GizmoPart::None) workspace_.endMerge();
    gizmo_ = {};
    gizmo_pose_.reset();
}

void Editor::select(ui::Selection selection) {
    if (!(selection == selection_)) dropGizmo();
    selection_ = std::move(selection);
    selected_point_objects_ = objectsOfSelectedPoint();
    // One wants to see what a point sees.
    preview_.shows_selection = selection_.kind == ui::Selection::Kind::PositionPoint;
    if (selection_.kind == ui::Selection::Kind::Frame) goToFrame(selection_.index);
    if (!selection_.objects.empty()) objects_.scroll_to = selection_.objects.back();
    if (selection_.kind != ui::Selection::Kind::None) focus_tab_ = "Selection";
}

void Editor::selectObject(int object, bool add) {
    std::vector<int> objects = add ? selection_.objects : std::vector<int>();
    const auto at = std::ranges::find(objects, object);
    if (at != objects.end()) {
        objects.erase(at);
    } else if (object != 0) {
        objects.push_back(object);
    }
    ui::Selection selection;
    if (!objects.empty()) {
        selection.kind =
            objects.size() == 1 ? ui::Selection::Kind::Object : ui::Selection::Kind::Objects;
    }
    selection.objects = std::move(objects);
    select(std::move(selection));
}

void Editor::keepSelection() {
    using Kind = ui::Selection::Kind;
    if (selection_.kind == Kind::None) return;
    const Plan* now = plan();
    const auto fits = [&](std::size_t count) {
        return selection_.index >= 0 && static_cast<std::size_t>(selection_.index) < count;
    };
    // A frame is a moment; a point is what it looks at; other numbers mean something else now.
    if (now != nullptr && selection_.kind == Kind::Frame && fits(now->trajectory.frames.size())) {
        return;
    }
    if (now != nullptr && !selected_point_objects_.empty()) {
        for (std::size_t i = 0; i < now->observation_points.size(); ++i) {
            if (now->observation_points[i].objects != selected_point_objects_) continue;
            const int found = selection_.kind == Kind::ObservationPoint
                                  ? static_cast<int>(i)
                                  : positionPointFor(*now, static_cast<int>(i));
            if (found < 0) break;
            selection_.index = found;
            return;
        }
    }
    selection_ = {};
    dropGizmo();
}

void Editor::goToFrame(int frame) {
    frame_ = std::clamp(frame, 0, std::max(frameCount() - 1, 0));
    preview_.shows_selection = false;
}

void Editor::lookThroughFrame(bool through) {
    if (through == through_camera_) return;
    through_camera_ = through;
    if (through || plan() == nullptr || frame_ >= frameCount()) return;
    // Leaves the camera where it was, so that one goes on looking from there.
    viewport_.camera.orthographic = false;
    viewport_.camera.standAt(plan()->trajectory.frames[static_cast<std::size_t>(frame_)].pose, 1.5);
}

void Editor::lookAlongPose(const Pose& pose) {
    through_camera_ = false;
    viewport_.camera.orthographic = false;
    viewport_.camera.standAt(pose, 1.5);
}

void Editor::bringIntoView(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return;
    lookThroughFrame(false);
    ui::ViewerCamera camera = viewport_.camera;
    camera.frame(box, static_cast<double>(pane_.width) / std::max(pane_.height, 1));
    camera.distance = std::max(camera.distance, 0.8);
    viewport_.camera = camera;
    const PlanOutcome& shown = workspace_.shown();
    if (!shown.rays || camera.orthographic) return;
    // Small things stand in front of walls and inside furniture: of the directions near the present
    // one the first from which nothing hides the thing.
    const Eigen::AlignedBox3d building = shown.scene->room_bounds;
    const double radius = 0.5 * box.sizes().norm();
    for (const double raised : {0.0, 0.3, -0.3, 0.6, -0.6}) {
        for (const double turned :
             {0.0, 0.4, -0.4, 0.8, -0.8, 1.3, -1.3, 1.9, -1.9, 2.5, -2.5, 3.1}) {
            ui::ViewerCamera tried = camera;
            tried.azimuth += turned;
            tried.elevation = std::clamp(tried.elevation + raised, 0.05, 1.5);
            const Eigen::Vector3d eye = tried.pose().position;
            const Eigen::Vector3d border = tried.pivot + 1.02 * radius * tried.towardsViewer();
            // From outside, ceilings and near walls are left away.
            const bool from_above = !building.contains(eye) && tried.elevation > 0.5;
            if (!from_above && tried.distance > radius && !shown.rays->sees(eye, border)) continue;
            if (!from_above && !building.contains(eye)) continue;
            viewport_.camera = tried;
            return;
        }
    }
}

void Editor::runKeypad() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || !workspace_.shown().scene) return;
    for (const KeypadKey& key : keypad_) {
        if (ImGui::IsKeyPressed(key.key) && key.ctrl == io.KeyCtrl) key.run();
    }
}

std::vector<int> Editor::objectsOfSelectedPoint() const {
    using Kind = ui::Selection::Kind;
    if (plan() == nullptr || selection_.index < 0) return {};
    auto index = static_cast<std::size_t>(selection_.index);
    if (selection_.kind == Kind::PositionPoint && index < plan()->position_points.size()) {
        index = static_cast<std::size_t>(plan()->position_points[index].observation_point);
    } else if (selection_.kind != Kind::ObservationPoint) {
        return {};
    }
    if (index >= plan()->observation_points.size()) return {};
    return plan()->observation_points[index].objects;
}

int Editor::frameCount() const {
    return plan() != nullptr ? static_cast<int>(plan()->trajectory.frames.size()) : 0;
}

Eigen::AlignedBox3d Editor::selectedBox() const {
    using Kind = ui::Selection::Kind;
    Eigen::AlignedBox3d box;
    const auto& scene = workspace_.shown().scene;
    if (!scene) return box;
    for (const int id : selection_.objects) {
        for (const Eigen::Vector3d& corner : scene->object(id).box.corners()) box.extend(corner);
    }
    const auto around = [&](const Eigen::Vector3d& place) {
        box.extend(place - Eigen::Vector3d::Constant(0.4));
        box.extend(place + Eigen::Vector3d::Constant(0.4));
    };
    const auto index = static_cast<std::size_t>(std::max(selection_.index, 0));
    if (selection_.kind == Kind::Voxel) around(selection_.place);
    if (plan() != nullptr) {
        if (selection_.kind == Kind::PositionPoint && index < plan()->position_points.size()) {
            around(plan()->position_points[index].pose.position);
        }
        if (selection_.kind == Kind::ObservationPoint &&
            index < plan()->observation_points.size()) {
            around(plan()->observation_points[index].position);
        }
        if (selection_.kind == Kind::Frame && index < plan()->trajectory.frames.size()) {
            around(plan()->trajectory.frames[index].pose.position);
        }
    }
    if (selection_.kind == Kind::NoGoBox && index < workspace_.state().edits.plan.no_go.size()) {
        for (const auto& corner : workspace_.state().edits.plan.no_go[index].box.corners()) {
            box.extend(corner);
        }
    }
    return box;
}

std::optional<OrientedBox> Editor::boxAroundSelection() const {
    const Eigen::AlignedBox3d around = selectedBox();
    if (around.isEmpty()) return std::nullopt;
    return OrientedBox{around.center(), 0.5 * around.sizes(), 0.0};
}

}  // namespace dollytrack::editor
