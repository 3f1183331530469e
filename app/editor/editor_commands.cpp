#include "app/editor/editor.h"

#include "engine/document/object_key.h"
#include "planning/free_space/free_space.h"
#include "ui/panels/plan/edit_parts.h"
#include "ui/panels/selection/region_rows.h"
#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace dollytrack::editor {

using ui::Selection;

namespace {

ui::Shortcut key(int code) {
    return {code};
}
ui::Shortcut ctrl(int code) {
    return {code, true};
}
ui::Shortcut ctrlShift(int code) {
    return {code, true, true};
}

}  // namespace

void Editor::addCommands() {
    addFileCommands();
    addEditCommands();
    addViewCommands();
    addTimelineCommands();
    addObjectCommands();
}

void Editor::addFileCommands() {
    const auto needs_project = [this] {
        return workspace_.isOpen() ? std::string() : std::string("No scene is open.");
    };
    commands_.add({"file.open", "File", "Open…", ctrl(GLFW_KEY_O), [this] { askForFile("open"); }});
    commands_.add({"file.reload", "File", "Reload from disk", ctrl(GLFW_KEY_R),
                   [this] {
                       openAfterAsking(workspace_.path().empty() ? workspace_.sceneFile()
                                                                 : workspace_.path());
                   },
                   needs_project});
    commands_.add(
        {"file.save", "File", "Save", ctrl(GLFW_KEY_S), [this] { save(); }, needs_project});
    commands_.add({"file.save_as", "File", "Save as…", ctrlShift(GLFW_KEY_S),
                   [this] { askForFile("save"); }, needs_project});
    for (const UpAxis axis : {UpAxis('x'), UpAxis('y'), UpAxis('z'), UpAxis('x', true),
                              UpAxis('y', true), UpAxis('z', true)}) {
        commands_.add({"file.up_axis." + axis.text(),
                       "File",
                       "Read the scene with " + axis.text() + " up",
                       {},
                       [this, axis] {
                           nlohmann::json import = workspace_.importSettings();
                           import["up_axis"] = axis.text();
                           workspace_.readAgain(import);
                       },
                       needs_project});
    }
    commands_.add({"file.labels",
                   "File",
                   "Use a label file…",
                   {},
                   [this] { askForFile("labels"); },
                   needs_project});
    commands_.add({"file.no_labels",
                   "File",
                   "Use the built-in classes",
                   {},
                   [this] {
                       nlohmann::json import = workspace_.importSettings();
                       import.erase("labels");
                       workspace_.readAgain(import);
                   },
                   [this, needs_project] {
                       if (!workspace_.isOpen()) return needs_project();
                       return workspace_.importSettings().contains("labels")
                                  ? std::string()
                                  : std::string("The project has no label file.");
                   }});
    commands_.add({"file.write_annotations",
                   "File",
                   "Write annotations…",
                   {},
                   [this] { askForFile("annotations"); },
                   needs_project});
    commands_.add(
        {"file.close", "File", "Close", ctrl(GLFW_KEY_W),
         [this] { questions_.afterUnsaved([this] { workspace_.close(); }, "before it is closed"); },
         needs_project});
    commands_.add({"file.export", "File", "Export the dataset…", ctrl(GLFW_KEY_E),
                   [this] {
                       settings_.layout.show_bottom = true;
                       focus_tab_ = "Export";
                   },
                   needs_project});
    commands_.add({"file.quit", "File", "Quit", ctrl(GLFW_KEY_Q), [this] {
                       const auto leave = [this] {
                           // The work was saved or deliberately discarded.
                           autosave_.discard();
                           quitting_ = true;
                       };
                       questions_.afterUnsaved([this, leave] { questions_.afterExports(leave); },
                                               "before you leave");
                   }});
}

void Editor::addEditCommands() {
    commands_.add({"edit.undo", "Edit", "Undo", ctrl(GLFW_KEY_Z), [this] { workspace_.undo(); },
                   [this]() -> std::string {
                       return workspace_.history().canUndo() ? "" : "There is nothing to undo.";
                   }});
    commands_.add({"edit.redo", "Edit", "Redo", ctrlShift(GLFW_KEY_Z),
                   [this] { workspace_.redo(); },
                   [this]() -> std::string {
                       return workspace_.history().canRedo() ? "" : "There is nothing to redo.";
                   }});
    commands_.add({"edit.redo_y", "Edit", "Redo (Ctrl+Y)", ctrl(GLFW_KEY_Y),
                   [this] { workspace_.redo(); },
                   [this]() -> std::string {
                       return workspace_.history().canRedo() ? "" : "There is nothing to redo.";
                   }});
    const auto needs_object = [this]() -> std::string {
        if (!workspace_.shown().scene) return "No scene is open.";
        return selected_.objects().empty() ? "Select an object first." : "";
    };
    commands_.add(
        {"edit.exclude", "Edit", "Exclude the selection", key(GLFW_KEY_X),
         [this] {
             apply({{"op", "exclude"},
                    {"object", objectKeys(*workspace_.shown().scene, selected_.objects())}});
         },
         needs_object});
    commands_.add(
        {"edit.include",
         "Edit",
         "Make the selection a target",
         {GLFW_KEY_X, false, true},
         [this] {
             apply({{"op", "include"},
                    {"object", objectKeys(*workspace_.shown().scene, selected_.objects())}});
         },
         needs_object});
    commands_.add({"edit.split",
                   "Edit",
                   "Split into connected pieces",
                   {},
                   [this] {
                       const int id = selected_.objects().front();
                       apply(ui::splitOperation(id, panels_.selection.split));
                   },
                   [this]() -> std::string {
                       if (selected_.objects().size() != 1) return "Select one object first.";
                       ui::SelectionView view;
                       view.piece_sizes_m =
                           pieces_.of(workspace_.shown().scene, selected_.objects().front());
                       return ui::whyNoSplit(view, panels_.selection.split);
                   }});
    commands_.add({"edit.add_point", "Edit", "Add a position point here", key(GLFW_KEY_P),
                   [this] {
                       const Pose pose = viewportView(panels_.viewport.camera).pose;
                       apply({{"op", "add_point"},
                              {"position", ui::pointJson(pose.position)},
                              {"quaternion_xyzw", ui::turnJson(pose.rotation)}});
                   },
                   [this]() -> std::string {
                       if (workspace_.shown().scene == nullptr) return "No scene is open.";
                       return panels_.viewport.camera.orthographic
                                  ? "Switch to perspective (5) first."
                                  : "";
                   }});
    commands_.add({"edit.pin_point", "Edit", "Pin the position point, or unpin it", key(GLFW_KEY_L),
                   [this] { lockSelectedPoint(); },
                   [this]() -> std::string {
                       return selected_.is(Selection::Kind::PositionPoint)
                                  ? ""
                                  : "Select a position point first.";
                   }});
    commands_.add({"edit.delete", "Edit", "Delete the selection", key(GLFW_KEY_DELETE),
                   [this] { deleteSelected(); },
                   [this]() -> std::string {
                       const bool can = selected_.is(Selection::Kind::PositionPoint) ||
                                        selected_.is(Selection::Kind::ObservationPoint) ||
                                        selected_.is(Selection::Kind::NoGoBox) ||
                                        selected_.is(Selection::Kind::Region);
                       return can ? "" : "Select a position point or a box first.";
                   }});
    commands_.add(
        {"edit.add_no_go", "Edit", "Add a no-go box", key(GLFW_KEY_N),
         [this] {
             applyRequest(
                 {ui::addNoGoOperation(boxAroundSelection().value_or(boxInView())), {}, false});
         },
         [this]() -> std::string { return workspace_.shown().scene ? "" : "No scene is open."; }});
    commands_.add(
        {"edit.add_region",
         "Edit",
         "Add a region",
         {},
         [this] {
             applyRequest(
                 {ui::addRegionOperation(boxAroundSelection().value_or(boxInView())), {}, false});
         },
         [this]() -> std::string { return workspace_.shown().scene ? "" : "No scene is open."; }});
    commands_.add({"edit.select_none", "Edit", "Select nothing", key(GLFW_KEY_ESCAPE), [this] {
                       if (gizmo_.dragging()) {
                           cancelDrag();
                       } else if (workspace_.loading().busy) {
                           workspace_.cancelOpening();
                       } else if (panels_.preview.full) {
                           panels_.preview.full = false;
                       } else if (through_camera_) {
                           lookThroughFrame(false);
                       } else {
                           selected_.clear();
                       }
                   }});
}

void Editor::addViewCommands() {
    const auto needs_scene = [this]() -> std::string {
        return workspace_.shown().scene ? "" : "No scene is open.";
    };
    const auto aspect = [this] {
        return static_cast<double>(pane_.width) / std::max(pane_.height, 1);
    };
    commands_.add({"view.frame_selected", "View", "Show the selection", key(GLFW_KEY_F),
                   [this] { bringIntoView(selectedBox()); },
                   [this]() -> std::string {
                       return selectedBox().isEmpty() ? "Select something first." : "";
                   }});
    commands_.add({"view.frame_all", "View", "Show everything", key(GLFW_KEY_HOME),
                   [this, aspect] {
                       lookThroughFrame(false);
                       panels_.viewport.camera.frame(workspace_.shown().scene->room_bounds,
                                                     aspect());
                       panels_.viewport.camera.distance *= 0.78;
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
            lookThroughFrame(false);
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
    const auto orthographic = [this] {
        lookThroughFrame(false);
        panels_.viewport.camera.orthographic = !panels_.viewport.camera.orthographic;
    };
    commands_.add({"view.orthographic", "View", "Parallel projection", key(GLFW_KEY_5),
                   orthographic, needs_scene,
                   [this] { return panels_.viewport.camera.orthographic; }});
    keypad_.push_back({GLFW_KEY_KP_5, false, orthographic});
    const auto through = [this] { lookThroughFrame(!through_camera_); };
    commands_.add(
        {"view.through_camera", "View", "Look through the camera", key(GLFW_KEY_0), through,
         [this]() -> std::string { return frameCount() > 0 ? "" : "There is no trajectory."; },
         [this] { return through_camera_; }});
    keypad_.push_back({GLFW_KEY_KP_0, false, through});
    commands_.add({"view.hide", "View", "Hide the selection", key(GLFW_KEY_H),
                   [this] { selected_.hideObjects(); },
                   [this]() -> std::string {
                       return selected_.objects().empty() ? "Select an object first." : "";
                   }});
    commands_.add({"view.show_all",
                   "View",
                   "Show all hidden objects",
                   {GLFW_KEY_H, false, false, true},
                   [this] { selected_.showAll(); },
                   needs_scene});
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
    commands_.add({"layer.slice_up", "Layers", "Raise the slice of free space",
                   key(GLFW_KEY_PAGE_UP), [slice] { slice(1.0); }, needs_map});
    commands_.add({"layer.slice_down", "Layers", "Lower the slice of free space",
                   key(GLFW_KEY_PAGE_DOWN), [slice] { slice(-1.0); }, needs_map});
    commands_.add({"layer.slice_height",
                   "Layers",
                   "Slice height of free space\u2026",
                   {},
                   [this] {
                       layer_settings_.free_space = layer_settings_.sliced = true;
                       settings_.layout.show_left = true;
                       focus_tab_ = "Layers";
                   },
                   needs_map});
    layer("points", "Observation and position points", {GLFW_KEY_F3}, layers.points);
    layer("roadmap", "Roadmap", {GLFW_KEY_F4}, layers.roadmap);
    layer("trajectory", "Trajectory", {GLFW_KEY_F5}, layers.trajectory);
    layer("candidates", "Candidates of the selection", {GLFW_KEY_F6}, layers.candidates);
    layer("no_go", "No-go boxes, regions", {GLFW_KEY_F7}, layers.no_go_boxes);
    layer("ceilings", "Cut ceilings away", {GLFW_KEY_F8}, layers.ceiling_cut);
    commands_.add({"view.preview",
                   "View",
                   "Preview of the camera",
                   key(GLFW_KEY_C),
                   [this] { panels_.preview.open = !panels_.preview.open; },
                   {},
                   [this] { return panels_.preview.open; }});
    commands_.add({"window.left",
                   "Window",
                   "Left panels",
                   {},
                   [this] { settings_.layout.show_left = !settings_.layout.show_left; },
                   {},
                   [this] { return settings_.layout.show_left; }});
    commands_.add({"window.right",
                   "Window",
                   "Right panels",
                   {},
                   [this] { settings_.layout.show_right = !settings_.layout.show_right; },
                   {},
                   [this] { return settings_.layout.show_right; }});
    commands_.add({"window.bottom",
                   "Window",
                   "Bottom panels",
                   {},
                   [this] { settings_.layout.show_bottom = !settings_.layout.show_bottom; },
                   {},
                   [this] { return settings_.layout.show_bottom; }});
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
        {"window.larger", "Window", "Larger text", ctrl(GLFW_KEY_EQUAL), [zoom] { zoom(1.1); }});
    commands_.add({"window.smaller", "Window", "Smaller text", ctrl(GLFW_KEY_MINUS),
                   [zoom] { zoom(1.0 / 1.1); }});
    commands_.add({"window.fullscreen", "Window", "Full screen", key(GLFW_KEY_F11),
                   [this] { window_.toggleFullscreen(); }});
    commands_.add({"help.keys", "Help", "Keys and mouse", key(GLFW_KEY_F1),
                   [this] { panels_.help.open = true; }});
    commands_.add({"help.palette", "Help", "Find a command, parameter or object", ctrl(GLFW_KEY_P),
                   [this] { panels_.palette.open = true; }});
}

void Editor::addTimelineCommands() {
    const auto needs_frames = [this]() -> std::string {
        return frameCount() > 0 ? "" : "There is no trajectory.";
    };
    const auto add = [&](const char* id, const char* title, ui::Shortcut keys,
                         std::function<void()> run) {
        commands_.add(
            {"timeline." + std::string(id), "Timeline", title, keys, std::move(run), needs_frames});
    };
    add("play", "Play or pause", key(GLFW_KEY_SPACE), [this] { playback_.toggle(); });
    add("next", "Next frame", key(GLFW_KEY_RIGHT), [this] { goToFrame(playback_.frame() + 1); });
    add("previous", "Previous frame", key(GLFW_KEY_LEFT),
        [this] { goToFrame(playback_.frame() - 1); });
    add("next_key", "Next key frame", {GLFW_KEY_RIGHT, false, true}, [this] {
        if (const auto key = ui::neighbourKey(plan_timeline_.keys(), playback_.frame(), 1))
            goToFrame(*key);
    });
    add("previous_key", "Previous key frame", {GLFW_KEY_LEFT, false, true}, [this] {
        if (const auto key = ui::neighbourKey(plan_timeline_.keys(), playback_.frame(), -1))
            goToFrame(*key);
    });
    add("first", "First frame", {GLFW_KEY_HOME, true}, [this] { goToFrame(0); });
    add("last", "Last frame", {GLFW_KEY_END, true}, [this] { goToFrame(frameCount() - 1); });
}

void Editor::lockSelectedPoint() {
    if (selected_.positionPoint(plan()) == nullptr) return;
    const PositionPoint& point = *selected_.positionPoint(plan());
    const auto& pinned = workspace_.shown().state->edits.plan.pinned;
    if (point.pin >= 0 && static_cast<std::size_t>(point.pin) < pinned.size()) {
        apply({{"op", "unpin"}, {"point", pinned[static_cast<std::size_t>(point.pin)].name}});
        return;
    }
    const auto& objects =
        plan()->observation_points[static_cast<std::size_t>(point.observation_point)].objects;
    apply({{"op", "pin"},
           {"objects", objectKeys(*workspace_.shown().scene, objects)},
           {"position", ui::pointJson(point.pose.position)},
           {"quaternion_xyzw", ui::turnJson(point.pose.rotation)}});
}

void Editor::deleteSelected() {
    const auto index = selected_.index();
    if (selected_.is(Selection::Kind::NoGoBox)) {
        const auto& boxes = workspace_.state().edits.plan.no_go;
        if (index < boxes.size()) apply({{"op", "remove_no_go"}, {"name", boxes[index].name}});
    } else if (selected_.is(Selection::Kind::Region)) {
        const auto& regions = workspace_.state().edits.plan.regions;
        if (index < regions.size()) apply({{"op", "remove_region"}, {"name", regions[index].name}});
    } else if (plan() != nullptr) {
        std::size_t target = index;
        if (selected_.is(Selection::Kind::PositionPoint)) {
            if (index >= plan()->position_points.size()) return;
            const PositionPoint& point = plan()->position_points[index];
            const auto& pinned = workspace_.shown().state->edits.plan.pinned;
            const auto pin = static_cast<std::size_t>(std::max(point.pin, 0));
            // A point placed from a view has no object, so removing its pin removes it.
            if (point.pin >= 0 && pin < pinned.size() && pinned[pin].objects.empty()) {
                apply({{"op", "unpin"}, {"point", pinned[pin].name}});
                selected_.clear();
                return;
            }
            target = static_cast<std::size_t>(std::max(point.observation_point, 0));
        }
        if (target >= plan()->observation_points.size()) return;
        apply({{"op", "remove_point"},
               {"objects", objectKeys(*workspace_.shown().scene,
                                      plan()->observation_points[target].objects)}});
    }
    selected_.clear();
}

void Editor::drawMenus() {
    if (!ImGui::BeginMainMenuBar()) return;
    const auto menu = [this](const char* group, const std::function<void()>& more = {}) {
        if (!ImGui::BeginMenu(group)) return;
        for (const ui::Command& command : commands_.all()) {
            if (command.group == group) commands_.drawMenuItem(command.id);
        }
        if (more) more();
        ImGui::EndMenu();
    };
    menu("File", [this] {
        ImGui::Separator();
        ImGui::TextDisabled("Recent");
        const std::vector<std::string> recent = settings_.recent;
        for (std::size_t i = 0; i < recent.size(); ++i) {
            std::error_code ignored;
            const std::filesystem::path path = recent[i];
            // Checking ten files is fast enough, and only done while the menu is open.
            const bool there = std::filesystem::exists(path, ignored);
            const std::string text = path.filename().string() + "##" + std::to_string(i);
            if (ImGui::MenuItem(text.c_str(), nullptr, false, there)) openAfterAsking(path);
            ui::nameItem("recent." + std::to_string(i), there);
            if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
                ImGui::SetTooltip("%s%s", recent[i].c_str(), there ? "" : "\nThis file is gone.");
            }
        }
    });
    ui::nameItem("menu.file");
    menu("Edit");
    ui::nameItem("menu.edit");
    menu("View");
    ui::nameItem("menu.view");
    menu("Layers");
    ui::nameItem("menu.layers");
    menu("Timeline");
    ui::nameItem("menu.timeline");
    menu("Window");
    ui::nameItem("menu.window");
    menu("Help");
    ui::nameItem("menu.help");
    ImGui::EndMainMenuBar();
}

}  // namespace dollytrack::editor
