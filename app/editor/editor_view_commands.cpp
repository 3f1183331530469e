#include "app/editor/editor.h"

#include "engine/geometry/ray_caster.h"
#include "planning/free_space/free_space.h"
#include "render/draw/storey_cutaway.h"
#include "ui/viewport/unobstructed_view.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dollytrack::editor {

void Editor::addViewCommands() {
    const auto needs_scene = [this]() -> std::string {
        return workspace_.shown().scene ? "" : "No scene is open.";
    };
    const auto aspect = [this] {
        return static_cast<double>(pane_.width) / std::max(pane_.height, 1);
    };
    commands_.add({"view.frame_selected",
                   "View",
                   "Show the selection",
                   {GLFW_KEY_F},
                   [this] { bringIntoView(selectedBox()); },
                   [this]() -> std::string {
                       return selectedBox().isEmpty() ? "Select something first." : "";
                   },
                   {},
                   {GLFW_KEY_KP_DECIMAL}});
    commands_.add({"view.frame_all",
                   "View",
                   "Show everything",
                   {GLFW_KEY_HOME},
                   [this, aspect] {
                       leaveCameraView();
                       panels_.viewport.camera.frame(workspace_.shown().scene->room_bounds,
                                                     aspect());
                   },
                   needs_scene});
    using Axis = ui::ViewerCamera::Axis;
    struct AxisKey {
        const char* id;
        const char* title;
        int digit;
        bool opposite;
        Axis axis;
    };
    static constexpr AxisKey kAxes[] = {{"front", "From the front", 1, false, Axis::Front},
                                        {"back", "From the back", 1, true, Axis::Back},
                                        {"right", "From the right", 3, false, Axis::Right},
                                        {"left", "From the left", 3, true, Axis::Left},
                                        {"top", "From above", 7, false, Axis::Top},
                                        {"bottom", "From below", 7, true, Axis::Bottom}};
    for (const AxisKey& view : kAxes) {
        const auto look = [this, axis = view.axis] {
            leaveCameraView();
            panels_.viewport.camera.lookFrom(axis);
        };
        commands_.add({"view." + std::string(view.id),
                       "View",
                       view.title,
                       {GLFW_KEY_0 + view.digit, view.opposite},
                       look,
                       needs_scene});
        keypad_.push_back({GLFW_KEY_KP_0 + view.digit, view.opposite, look});
    }
    struct OrbitKey {
        const char* id;
        const char* title;
        int key;
        int right, up;
    };
    static constexpr OrbitKey kOrbits[] = {
        {"orbit_left", "Orbit 15\u00b0 to the left", GLFW_KEY_KP_4, -1, 0},
        {"orbit_right", "Orbit 15\u00b0 to the right", GLFW_KEY_KP_6, 1, 0},
        {"orbit_up", "Orbit 15\u00b0 upwards", GLFW_KEY_KP_8, 0, 1},
        {"orbit_down", "Orbit 15\u00b0 downwards", GLFW_KEY_KP_2, 0, -1}};
    for (const OrbitKey& orbit : kOrbits) {
        commands_.add({"view." + std::string(orbit.id),
                       "View",
                       orbit.title,
                       {orbit.key},
                       [this, orbit] {
                           leaveCameraView();
                           panels_.viewport.camera.orbitBySteps(orbit.right, orbit.up);
                       },
                       needs_scene});
    }
    commands_.add({"view.opposite",
                   "View",
                   "From the opposite side",
                   {GLFW_KEY_KP_9},
                   [this] {
                       leaveCameraView();
                       panels_.viewport.camera.lookFromOpposite();
                   },
                   needs_scene});
    const auto orthographic = [this] {
        leaveCameraView();
        panels_.viewport.camera.orthographic = !panels_.viewport.camera.orthographic;
    };
    commands_.add({"view.orthographic",
                   "View",
                   "Parallel projection",
                   {GLFW_KEY_5},
                   orthographic,
                   needs_scene,
                   [this] { return panels_.viewport.camera.orthographic; }});
    keypad_.push_back({GLFW_KEY_KP_5, false, orthographic});
    const auto through = [this] {
        if (through_camera_) return leaveCameraView();
        through_camera_ = frameCount() > 0;
    };
    commands_.add(
        {"view.through_camera",
         "View",
         "Look through the camera",
         {GLFW_KEY_0},
         through,
         [this]() -> std::string { return frameCount() > 0 ? "" : "There is no trajectory."; },
         [this] { return through_camera_; }});
    keypad_.push_back({GLFW_KEY_KP_0, false, through});
    commands_.add({"view.light",
                   "View",
                   "Compute the light",
                   {},
                   [this] {
                       if (workspace_.lighting()) return workspace_.stopLight();
                       workspace_.startLight();
                   },
                   [this]() -> std::string {
                       if (workspace_.lighting() || workspace_.lighter().stopped()) return "";
                       return workspace_.lighter().isFinal() ? "The light is computed already."
                                                             : "There is no plan to light yet.";
                   },
                   [this] { return workspace_.lighting(); }});
    commands_.add({"view.preview",
                   "View",
                   "Preview of the camera",
                   {GLFW_KEY_C},
                   [this] { panels_.preview.open = !panels_.preview.open; },
                   {},
                   [this] { return panels_.preview.open; }});
}

void Editor::addHidingCommands() {
    const auto needs_scene = [this]() -> std::string {
        return workspace_.shown().scene ? "" : "No scene is open.";
    };
    commands_.add({"view.hide",
                   "View",
                   "Hide the selection",
                   {GLFW_KEY_H},
                   [this] { selected_.hideObjects(); },
                   [this]() -> std::string {
                       return selected_.objects().empty() ? "Select an object first." : "";
                   }});
    commands_.add({"view.show_all",
                   "View",
                   "Show all hidden objects",
                   {GLFW_KEY_H, false, false, true},
                   [this] { selected_.showAll(); },
                   [this]() -> std::string {
                       return std::ranges::count(selected_.hidden(), true) > 0
                                  ? ""
                                  : "No object is hidden.";
                   }});
    const auto local = [this] { toggleLocalView(); };
    commands_.add({"view.local",
                   "View",
                   "Local view: only the selection",
                   {GLFW_KEY_SLASH},
                   local,
                   [this]() -> std::string {
                       const bool can = selected_.inLocalView() || !selected_.objects().empty();
                       return can ? "" : "Select an object first.";
                   },
                   [this] { return selected_.inLocalView(); }});
    keypad_.push_back({GLFW_KEY_KP_DIVIDE, false, local});
    commands_.add({"view.clip_box",
                   "View",
                   "Clipping box around the selection",
                   {GLFW_KEY_B, false, false, true},
                   [this] { toggleClipBox(); },
                   needs_scene,
                   [this] { return clip_.has_box; }});
    commands_.add({"view.hide_above",
                   "View",
                   "Hide everything above a height",
                   {},
                   [this] {
                       clip_.begin(workspace_.shown().scene->room_bounds);
                       clip_.hides_above = !clip_.hides_above;
                       docks_.open(panelName(Panel::Layers));
                   },
                   needs_scene,
                   [this] { return clip_.hides_above; }});
}

void Editor::addLayerCommands() {
    const auto layer = [this](const char* id, const char* title, ui::Shortcut keys, bool& on) {
        commands_.add({"layer." + std::string(id),
                       "Layers",
                       title,
                       keys,
                       [&on] { on = !on; },
                       {},
                       [&on] { return on; }});
    };
    ui::LayerSettings& layers = layer_settings_;
    layer("free_space", "Free space", {GLFW_KEY_F2}, layers.free_space);
    const auto needs_map = [this]() -> std::string {
        return workspace_.shown().free_space ? "" : "The map is not built yet.";
    };
    const auto slice = [this](double way) {
        // Moving the slice shows it.
        layer_settings_.free_space = layer_settings_.sliced = true;
        ui::Slice& now = layer_settings_.slice;
        const Eigen::AlignedBox3d& room = workspace_.shown().scene->room_bounds;
        now.position_m =
            std::clamp(now.position_m + way * workspace_.shown().free_space->resolution_m(),
                       room.min()[now.axis], room.max()[now.axis]);
    };
    commands_.add({"layer.slice_up",
                   "Layers",
                   "Raise the slice of free space",
                   {GLFW_KEY_PAGE_UP},
                   [slice] { slice(1.0); },
                   needs_map});
    commands_.add({"layer.slice_down",
                   "Layers",
                   "Lower the slice of free space",
                   {GLFW_KEY_PAGE_DOWN},
                   [slice] { slice(-1.0); },
                   needs_map});
    commands_.add({"layer.slice_height",
                   "Layers",
                   "Slice height of free space\u2026",
                   {},
                   [this] {
                       layer_settings_.free_space = layer_settings_.sliced = true;
                       docks_.open(panelName(Panel::Layers));
                   },
                   needs_map});
    layer("points", "Observation and position points", {GLFW_KEY_F3}, layers.points);
    layer("roadmap", "Roadmap", {GLFW_KEY_F4}, layers.roadmap);
    layer("trajectory", "Trajectory", {GLFW_KEY_F5}, layers.trajectory);
    layer("candidates", "Candidates of the selection", {GLFW_KEY_F6}, layers.candidates);
    layer("quality", "Weak frames and unseen surface", {}, layers.quality);
    layer("no_go", "No-go boxes, regions", {GLFW_KEY_F7}, layers.no_go_boxes);
    layer("ceilings", "Cut ceilings away", {GLFW_KEY_F8}, layers.ceiling_cut);
}

void Editor::addWindowCommands() {
    for (const auto& [side, title] :
         {std::pair(DockSide::Left, "Left panels"), std::pair(DockSide::Right, "Right panels"),
          std::pair(DockSide::Bottom, "Bottom panels")}) {
        commands_.add({fmt::format("window.{}", sideName(side)),
                       "Window",
                       title,
                       {},
                       [this, side] { docks_.toggleSide(side); },
                       {},
                       [this, side] { return docks_.places().isVisible(side); }});
    }
    commands_.add(
        {"window.standard_panels", "Window", "All panels to their standard places", {}, [this] {
             docks_.reset();
         }});
    for (const DockSide side : kDockSides) {
        for (const std::string& panel : standardPlaces().at(side)) {
            commands_.add(
                {"panel." + panel, "Panels", panel, {}, [this, panel] { docks_.open(panel); }});
        }
    }
    commands_.add({"window.light",
                   "Window",
                   "Light theme",
                   {},
                   [this] {
                       const bool dark = settings_.theme == ui::ThemeKind::Dark;
                       settings_.theme = dark ? ui::ThemeKind::Light : ui::ThemeKind::Dark;
                       setTheme();
                   },
                   {},
                   [this] { return settings_.theme == ui::ThemeKind::Light; }});
    const auto zoom = [this](double factor) {
        settings_.zoom = std::clamp(settings_.zoom * factor, 0.5, 3.0);
        setTheme();
        window_.requestFonts(window_.contentScale() * settings_.zoom);
    };
    commands_.add(
        {"window.larger", "Window", "Larger text", {GLFW_KEY_EQUAL, true}, [zoom] { zoom(1.1); }});
    commands_.add({"window.smaller", "Window", "Smaller text", {GLFW_KEY_MINUS, true}, [zoom] {
                       zoom(1.0 / 1.1);
                   }});
    commands_.add({"window.fullscreen", "Window", "Full screen", {GLFW_KEY_F11}, [this] {
                       window_.toggleFullscreen();
                   }});
    commands_.add({"help.keys", "Help", "Keys and mouse", {GLFW_KEY_F1}, [this] {
                       panels_.help.open = true;
                   }});
    commands_.add(
        {"help.palette", "Help", "Find a command, parameter or object", {GLFW_KEY_P, true}, [this] {
             panels_.palette.open = true;
         }});
}

std::optional<ui::GizmoView> Editor::clipView() {
    if (!clip_.has_box || through_camera_ || !workspace_.shown().scene) return std::nullopt;
    return handleView();
}

ui::GizmoView Editor::handleView() {
    ui::GizmoView view;
    view.view = drawing_.view().view;
    view.origin = pane_.origin;
    const std::optional<ui::GizmoView> handles = gizmoView();
    view.hovered = pane_.hovered && !preview_hovered_ && !panels_.legend.hovered &&
                   !panels_.viewport.box_select && !(handles && gizmo_.takesMouse(*handles));
    return view;
}

void Editor::drawClip() {
    const std::optional<ui::GizmoView> view = clipView();
    if (!view) {
        clip_handles_ = {};
        return;
    }
    ui::drawClipHandles(*view, clip_.box, clip_handles_);
    if (clip_handles_.dragged >= 0) window_.animate();
}

void Editor::toggleLocalView() {
    if (!selected_.inLocalView() && selected_.objects().empty()) return;
    leaveCameraView();
    selected_.toggleLocalView();
    if (selected_.inLocalView()) {
        view_before_local_ = panels_.viewport.camera;
        bringIntoView(selectedBox());
    } else {
        panels_.viewport.camera = view_before_local_;
    }
}

void Editor::toggleClipBox() {
    clip_.has_box = !clip_.has_box;
    if (!clip_.has_box) return;
    constexpr double kMargin_m = 0.1;
    const Eigen::AlignedBox3d around = selectedBox();
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin_m);
    clip_.begin(workspace_.shown().scene->room_bounds);
    if (!around.isEmpty()) clip_.box = {around.min() - margin, around.max() + margin};
}

void Editor::leaveCameraView() {
    if (!std::exchange(through_camera_, false)) return;
    // A drag continues from the pose of the plan's camera; a key or a menu restores the view
    // before.
    const bool drags = panels_.viewport.drag != ui::ViewportState::Drag::None;
    if (!drags || plan() == nullptr || playback_.frame() >= frameCount()) return;
    const Pose& pose = plan()->trajectory.frames[playback_.frame()].pose;
    constexpr double kNearest_m = 0.3, kFarthest_m = 4.0;  // pivot of the view
    double ahead_m = kFarthest_m;
    if (const auto& rays = workspace_.shown().rays) {
        const RayHit hit = rays->cast(pose.position, pose.forward(), kFarthest_m);
        if (hit.object_id != 0) ahead_m = std::max(hit.distance, kNearest_m);
    }
    panels_.viewport.camera.orthographic = false;
    panels_.viewport.camera.standAt(pose, ahead_m);
}

void Editor::lookAlongPose(const Pose& pose) {
    through_camera_ = false;
    panels_.viewport.camera.orthographic = false;
    panels_.viewport.camera.standAt(pose, 1.5);
}

void Editor::bringIntoView(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return;
    leaveCameraView();
    ui::ViewerCamera& camera = panels_.viewport.camera;
    camera.frame(box, static_cast<double>(pane_.width) / std::max(pane_.height, 1));
    camera.distance = std::max(camera.distance, 0.8);
}

void Editor::showUnobstructed(const Eigen::AlignedBox3d& box) {
    bringIntoView(box);
    const ui::ViewerCamera camera = panels_.viewport.camera;
    const PlanOutcome& shown = workspace_.shown();
    if (box.isEmpty() || !shown.rays || camera.orthographic) return;
    panels_.viewport.camera = ui::unobstructedView(camera, [&](const ui::ViewerCamera& tried) {
        const render::View view = viewportView(tried);
        const auto left_away = [&](int object, const Eigen::Vector3d& at) {
            return render::isCutAway(view, *shown.scene, object, at);
        };
        return ui::shareSeen(*shown.rays, tried.pose().position, box, left_away);
    });
}

}  // namespace dollytrack::editor
