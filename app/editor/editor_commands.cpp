#include "app/editor/editor.h"

#include "engine/plan/object_key.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/edits/motion_section.h"
#include "ui/panels/edits/region_rows.h"
#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

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
    addTargetCommands();
    addPointCommands();
    addSelectionCommands();
    addTransformCommands();
    addMotionCommands();
    addCameraKeyCommands();
    addComparisonCommands();
    addViewCommands();
    addHidingCommands();
    addLayerCommands();
    addTimelineCommands();
    addWindowCommands();
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
        const std::string title = "Read the scene with " + axis.text() + " up";
        commands_.add(
            {"file.up_axis." + axis.text(),
             "File",
             title,
             {},
             [this, axis, title] { workspace_.changeImport("up_axis", axis.text(), title); },
             needs_project,
             [this, axis] {
                 return workspace_.isOpen() && workspace_.importReport().up_axis == axis.text();
             },
             {},
             "Upward axis"});
    }
    struct LengthUnit {
        const char* id;
        const char* name;
        double unit_m;
    };
    static constexpr LengthUnit kUnits[] = {{"mm", "millimetres", 0.001},
                                            {"cm", "centimetres", 0.01},
                                            {"inch", "inches", 0.0254},
                                            {"foot", "feet", 0.3048},
                                            {"m", "metres", 1.0}};
    for (const LengthUnit& unit : kUnits) {
        const std::string title = std::string("Read the scene in ") + unit.name;
        commands_.add({std::string("file.unit.") + unit.id,
                       "File",
                       title,
                       {},
                       [this, unit_m = unit.unit_m, title] {
                           workspace_.changeImport("unit_m", unit_m, title);
                       },
                       needs_project,
                       [this, unit_m = unit.unit_m] {
                           constexpr double kSame = 1e-3;
                           return workspace_.isOpen() &&
                                  std::abs(workspace_.importReport().unit_m / unit_m - 1.0) < kSame;
                       },
                       {},
                       "Unit of length"});
    }
    commands_.add(
        {"file.unit.of_file",
         "File",
         "Determine the unit from the file",
         {},
         [this] { workspace_.changeImport("unit_m", nullptr, "Determine the unit from the file"); },
         [this, needs_project]() -> std::string {
             if (!workspace_.isOpen()) return needs_project();
             return workspace_.state().import.contains("unit_m")
                        ? ""
                        : "It is determined from the file.";
         },
         {},
         {},
         "Unit of length"});
    commands_.add({"file.unit.other",
                   "File",
                   "Read the scene in another unit…",
                   {},
                   [this] { askForUnit(); },
                   needs_project,
                   {},
                   {},
                   "Unit of length"});
    const auto keeps_meshes = [this] {
        return workspace_.isOpen() && !workspace_.state().import.value("regroup", true);
    };
    commands_.add({"file.keep_meshes",
                   "File",
                   "Keep the file's meshes as objects",
                   {},
                   [this, keeps_meshes] {
                       if (keeps_meshes()) {
                           workspace_.changeImport("regroup", nullptr, "Group meshes into objects");
                       } else {
                           workspace_.changeImport("regroup", false,
                                                   "Keep the file's meshes as objects");
                       }
                   },
                   needs_project,
                   keeps_meshes});
    commands_.add({"file.models",
                   "File",
                   "Add a folder of models…",
                   {},
                   [this] { askForFile("models"); },
                   needs_project});
    commands_.add({"file.labels",
                   "File",
                   "Use a label file…",
                   {},
                   [this] { askForFile("labels"); },
                   needs_project});
    commands_.add(
        {"file.no_labels",
         "File",
         "Use the built-in classes",
         {},
         [this] { workspace_.changeImport("labels", nullptr, "Use the built-in classes"); },
         [this, needs_project] {
             if (!workspace_.isOpen()) return needs_project();
             return workspace_.state().import.contains("labels")
                        ? std::string()
                        : std::string("The project has no label file.");
         }});
    commands_.add({"file.write_annotations",
                   "File",
                   "Write annotations…",
                   {},
                   [this] { askForFile("annotations"); },
                   needs_project});
    commands_.add({"file.import_motion",
                   "File",
                   "Import a camera path…",
                   {},
                   [this] { askForFile("camera path"); },
                   needs_project});
    commands_.add({"file.save_poses",
                   "File",
                   "Save the camera path…",
                   {},
                   [this] { askForFile("poses"); },
                   [this] {
                       return plan() != nullptr && !plan()->trajectory.frames.empty()
                                  ? std::string()
                                  : std::string("There is no camera path yet.");
                   }});
    commands_.add(
        {"file.close", "File", "Close", ctrl(GLFW_KEY_W),
         [this] { questions_.afterUnsaved([this] { workspace_.close(); }, "before it is closed"); },
         needs_project});
    commands_.add({"file.export", "File", "Export the dataset…", ctrl(GLFW_KEY_E),
                   [this] { docks_.open(panelName(Panel::Export)); }, needs_project});
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
    commands_.add({"edit.undo", "Edit", "Undo", ctrl(GLFW_KEY_Z),
                   [this] {
                       if (!undoMoveDrag()) workspace_.undo();
                   },
                   [this]() -> std::string {
                       const bool any = workspace_.history().canUndo() || lastMoveDrag() != nullptr;
                       return any ? "" : "There is nothing to undo.";
                   }});
    commands_.add({"edit.redo",
                   "Edit",
                   "Redo",
                   ctrlShift(GLFW_KEY_Z),
                   [this] { workspace_.redo(); },
                   [this]() -> std::string {
                       return workspace_.history().canRedo() ? "" : "There is nothing to redo.";
                   },
                   {},
                   ctrl(GLFW_KEY_Y)});
}

void Editor::addTargetCommands() {
    const auto why_not = [this](bool target) -> std::string {
        if (!workspace_.shown().scene) return "No scene is open.";
        if (selected_.objects().empty()) return "Select an object first.";
        const bool changes = std::ranges::any_of(selected_.objects(), [&](int id) {
            return (newestRole(id) == Role::Target) != target;
        });
        if (changes) return "";
        return target ? "All selected objects are targets already."
                      : "No selected object is a target.";
    };
    commands_.add(
        {"edit.exclude", "Edit", "Exclude the selection", key(GLFW_KEY_X),
         [this] {
             apply({{"op", "exclude"},
                    {"object", objectKeys(*workspace_.shown().scene, selected_.objects())}});
         },
         [why_not] { return why_not(false); }});
    commands_.add(
        {"edit.include",
         "Edit",
         "Make the selection a target",
         {GLFW_KEY_X, false, true},
         [this] {
             apply({{"op", "include"},
                    {"object", objectKeys(*workspace_.shown().scene, selected_.objects())}});
         },
         [why_not] { return why_not(true); }});
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
}

void Editor::addPointCommands() {
    commands_.add({"edit.add_point", "Edit", "Add a position point here", key(GLFW_KEY_P),
                   [this] {
                       const Pose pose = viewPose();
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
                   [this] { togglePin(); },
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
                                        selected_.is(Selection::Kind::Region) ||
                                        selectedKey() != nullptr;
                       return can ? "" : "Select a position point, a camera key or a box first.";
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
}

void Editor::addSelectionCommands() {
    commands_.add(
        {"edit.box_select", "Edit", "Select objects with a box", key(GLFW_KEY_B),
         [this] { panels_.viewport.box_select = true; },
         [this]() -> std::string { return workspace_.shown().scene ? "" : "No scene is open."; }});
    commands_.add(
        {"edit.select_all", "Edit", "Select all objects", key(GLFW_KEY_A), [this] { selectAll(); },
         [this]() -> std::string { return workspace_.shown().scene ? "" : "No scene is open."; }});
    commands_.add(
        {"edit.deselect", "Edit", "Select nothing", {GLFW_KEY_A, false, false, true}, [this] {
             select({});
         }});
    commands_.add(
        {"edit.cancel", "Edit", "Cancel, or select nothing", key(GLFW_KEY_ESCAPE), [this] {
             if (panels_.timeline.pressed_key >= 0) {
                 return;  // the timeline cancels the drag of its key
             } else if (gizmo_.dragging()) {
                 cancelDrag();
             } else if (move_preview_.dragging()) {
                 cancelMoveDrag();
             } else if (panels_.viewport.cancelBoxSelect()) {
                 return;
             } else if (workspace_.loading().busy) {
                 workspace_.cancelOpening();
             } else if (panels_.preview.full) {
                 panels_.preview.full = false;
             } else if (through_camera_) {
                 leaveCameraView();
             } else {
                 selected_.clear();
             }
         }});
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
    const auto needs_collision = [this]() -> std::string {
        return plan_timeline_.collisions().empty() ? "The camera path has no collision." : "";
    };
    commands_.add({"timeline.next_collision",
                   "Timeline",
                   "Next collision",
                   {GLFW_KEY_RIGHT, true},
                   [this] { goToCollision(1); },
                   needs_collision});
    commands_.add({"timeline.previous_collision",
                   "Timeline",
                   "Previous collision",
                   {GLFW_KEY_LEFT, true},
                   [this] { goToCollision(-1); },
                   needs_collision});
    add("first", "First frame", {GLFW_KEY_HOME, true}, [this] { goToFrame(0); });
    add("last", "Last frame", {GLFW_KEY_END, true}, [this] { goToFrame(frameCount() - 1); });
}

void Editor::togglePin() {
    if (selected_.positionPoint(plan()) == nullptr) return;
    const PositionPoint& point = *selected_.positionPoint(plan());
    const auto& pinned = workspace_.shown().state->edits.plan.pinned;
    if (point.pin >= 0 && static_cast<std::size_t>(point.pin) < pinned.size()) {
        apply({{"op", "unpin"}, {"point", pinned[point.pin].name}});
        return;
    }
    const auto& objects = plan()->observation_points[point.observation_point].objects;
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
    } else if (selectedKey() != nullptr) {
        apply(ui::removeCameraKeyOperation(index));
    } else if (plan() != nullptr) {
        std::size_t target = index;
        if (selected_.is(Selection::Kind::PositionPoint)) {
            if (index >= plan()->position_points.size()) return;
            const PositionPoint& point = plan()->position_points[index];
            const auto& pinned = workspace_.shown().state->edits.plan.pinned;
            const std::size_t pin = std::max(point.pin, 0);
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
        commands_.drawMenuItems(group);
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
    menu("Camera");
    ui::nameItem("menu.camera");
    menu("View");
    ui::nameItem("menu.view");
    menu("Layers");
    ui::nameItem("menu.layers");
    menu("Timeline");
    ui::nameItem("menu.timeline");
    menu("Window", [this] {
        ImGui::Separator();
        ImGui::TextDisabled("Places of panels");
        docks_.drawMenu();
    });
    ui::nameItem("menu.window");
    menu("Help");
    ui::nameItem("menu.help");
    ImGui::EndMainMenuBar();
}

}  // namespace dollytrack::editor
