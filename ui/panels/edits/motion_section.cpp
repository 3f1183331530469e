#include "ui/panels/edits/motion_section.h"

#include "engine/io/trajectories/trajectory_file.h"
#include "planning/motions/key_motion.h"
#include "planning/motions/move_settings.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/fields/choice_combo.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/form.h"
#include "ui/widgets/icon_button.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

namespace dollytrack::ui {
namespace {

constexpr std::array kWorlds = {"", "scene", "y-up", "z-up", "ned", "camera"};
/// Labels of kWorlds: the format's default, then the values of FileWorld in order.
constexpr std::array kWorldNames = {
    "Usual for the format",       "Axes and unit of the scene file", "m, y up", "m, z up",
    "m, north, east, down (NED)", "m, right, down, forward"};

/// Draws a clickable line about something wrong; returns whether it was clicked.
bool redLink(const std::string& text, const char* name, const std::string& tip) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().bad);
    const std::string shown =
        cutToWidth(text, std::max(ImGui::GetContentRegionAvail().x, scaled(60)), Cut::End);
    const bool pressed = ImGui::Selectable(shown.c_str());
    ImGui::PopStyleColor();
    nameItem(name);
    if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    tooltip(tip);
    return pressed;
}

/// "key 2", or "keys 2 and 3".
std::string keysText(const std::vector<std::size_t>& keys) {
    std::string text = keys.size() == 1 ? "key " : "keys ";
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (i > 0) text += i + 1 == keys.size() ? " and " : ", ";
        text += std::to_string(keys[i] + 1);
    }
    return text;
}

/// The keys where the camera cannot be.
std::vector<std::size_t> blockedKeys(const MotionView& view) {
    std::vector<std::size_t> blocked;
    for (std::size_t i = 0; i < view.key_states.size(); ++i) {
        if (!view.key_states[i].why_blocked.empty()) blocked.push_back(i);
    }
    return blocked;
}

/// Says whether the path collides and passes its keys, with buttons that go to the collisions.
void drawCollisions(const MotionView& view, MotionActions& actions) {
    int collisions = 0;
    std::size_t segments = 0;
    for (const SmoothPath& path : view.plan->smooth_paths) {
        collisions += path.collisions;
        segments += std::max<std::size_t>(path.pieces.size(), 1);
    }
    const std::vector<std::size_t> blocked = blockedKeys(view);
    if (collisions > 0) {
        if (redLink(fmt::format("\u25cb {} move{}", collisions,
                                collisions == 1 ? " collides" : "s collide"),
                    "edits.motion.collisions",
                    fmt::format(
                        "Of {} moves between frames, {} {} with an obstacle. Click to go to the "
                        "next collision (Ctrl+Right)",
                        segments, collisions, collisions == 1 ? "collides" : "collide"))) {
            actions.collision = 1;
        }
        if (button("Previous collision", "edits.motion.previous_collision",
                   {.tip = "Go to the previous collision (Ctrl+Left)", .small = true})) {
            actions.collision = -1;
        }
        flowTo("Next collision");
        if (button("Next collision", "edits.motion.next_collision",
                   {.tip = "Go to the next collision (Ctrl+Right)", .small = true})) {
            actions.collision = 1;
        }
        // Always a line, so that the buttons below stay where they are.
        const bool here = !view.collision_here.empty();
        cutText(here ? view.collision_here : "No collision at this frame.",
                here ? palette().bad : palette().text_dim);
    } else if (!blocked.empty()) {
        paragraph(fmt::format("\u25cb The path is free of collisions, but cannot pass {}: no "
                              "camera can be there.",
                              keysText(blocked)),
                  palette().bad);
    } else {
        ImGui::TextColored(palette().good, "\u25cf free of collisions");
    }
}

void drawState(const MotionView& view, MotionActions& actions) {
    const GivenMotion& motion = *view.motion;
    const bool has_keys = !motion.keys.empty();
    const std::string nameless =
        has_keys ? fmt::format("{} key{}, {:.1f} s", motion.keys.size(),
                               motion.keys.size() == 1 ? "" : "s", motion.duration_s())
                 : "Without a name";
    const Result<planning::MoveRequest> move = planning::parseMove(motion.name);
    const std::string title = motion.name.empty() ? nameless
                              : move              ? planning::settingLabel(move->kind)
                                                  : motion.name;
    cutText(title, ImGui::GetStyleColorVec4(ImGuiCol_Text),
            fmt::format("{}{} {}, {:.1f} s", move ? motion.name + "\n" : "",
                        has_keys ? motion.keys.size() : motion.frames.size(),
                        has_keys ? "keys" : "frames", motion.duration_s()),
            Cut::Middle);
    if (view.plan == nullptr) {
        if (view.why_not_checked.empty()) {
            ImGui::TextColored(palette().text_dim, "being checked \u2026");
        } else {
            paragraph(view.why_not_checked, palette().bad);
        }
        return;
    }
    drawCollisions(view, actions);
    if (!view.change.empty()) paragraph(view.change);
    if (view.why_not_compare &&
        button("Compare with unrepaired path", "edits.motion.compare",
               {.why_not = *view.why_not_compare,
                .tip = "Show both paths and their metrics (panel Metrics); replaces the plan kept "
                       "for comparison",
                .small = true})) {
        actions.compare = true;
    }
}

/// Draws a dot whose colour tells whether the camera can be at a key and passes it as wanted.
void drawKeyDot(const KeyState* state, const std::string& note) {
    const bool blocked = state != nullptr && !state->why_blocked.empty();
    const ImVec4& color = state == nullptr ? palette().text_dim
                          : blocked        ? palette().bad
                          : note.empty()   ? palette().good
                                           : palette().warning;
    ImGui::TextColored(color, blocked ? "\u25cb" : "\u25cf");
    tooltip(state == nullptr ? "Not checked yet"
            : blocked        ? "The key " + state->why_blocked
            : note.empty()   ? "The camera can be here"
                             : note);
}

/// Draws a row for a key and, below it, why the camera cannot be there or how the plan misses it.
void drawKey(const MotionView& view, std::size_t i, const std::string& note,
             MotionActions& actions) {
    const std::vector<MotionKey>& keys = view.motion->keys;
    const KeyState* state = i < view.key_states.size() ? &view.key_states[i] : nullptr;
    const std::string name = fmt::format("edits.motion.key.{}", i);
    const bool selected = view.selected_key == static_cast<int>(i);
    ImGui::AlignTextToFramePadding();
    drawKeyDot(state, note);
    ImGui::SameLine(scaled(18));
    if (link(fmt::format("{}Key {}", selected ? "> " : "", i + 1), name + ".select",
             "Select it; K then adds a key after it")) {
        actions.select_key = static_cast<int>(i);
    }
    ImGui::SameLine(scaled(76));
    ImGui::SetNextItemWidth(scaled(72));
    keyTimeField(keys, i, name + ".time", actions.edit);
    ImGui::SameLine();
    if (button("Go to", name + ".go_to", {.tip = "Fly the viewport's view here"})) {
        actions.look_through = keys[i].pose;
        actions.select_key = static_cast<int>(i);
    }
    ImGui::SameLine();
    if (iconButton(Icon::Close, name + ".delete", {.tip = "Remove this key"})) {
        actions.edit.operation = removeCameraKeyOperation(i);
    }
    const bool blocked = state != nullptr && !state->why_blocked.empty();
    if (!note.empty()) {
        paragraph(note, palette().bad);
    } else if (blocked) {
        paragraph(fmt::format("Key {} {}.", i + 1, state->why_blocked), palette().bad);
    }
    if (blocked && state->free_place) {
        const double away_m = (*state->free_place - keys[i].pose.position).norm();
        const std::string label = fmt::format("Move it by {:.2f} m to a free place", away_m);
        if (button(label.c_str(), name + ".free",
                   {.tip = "The nearest place where the camera can be", .small = true})) {
            actions.free_key = i;
        }
    }
}

/// One row for each key.
void drawKeys(const MotionView& view, MotionActions& actions) {
    const std::vector<MotionKey>& keys = view.motion->keys;
    const bool checked = view.plan != nullptr && view.plan->passed_keys.size() == keys.size();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        drawKey(view, i, checked ? view.plan->passed_keys[i].note : std::string(), actions);
        ImGui::PopID();
    }
    if (keys.size() == 1) {
        paragraph(
            "Fly on in the viewport (drag with the right button; W, A, S, D) and press K for the "
            "next key.",
            palette().text_dim);
    }
    if (checked && std::ranges::any_of(view.plan->passed_keys, [&](const PassedKey& passed) {
            const auto i = static_cast<std::size_t>(&passed - view.plan->passed_keys.data());
            return planning::isLate(passed.time_s - keys[i].time_s,
                                    view.plan->trajectory.frame_interval_s);
        })) {
        if (button("Set reachable times", "edits.motion.fit_keys",
                   {.tip = "Each key gets the time at which the camera reaches it"})) {
            actions.fit_keys = true;
        }
    }
}

void drawWorld(const MotionView& view, MotionActions& actions) {
    if (!view.can_read_again || !beginForm("motion file")) return;
    formLabel("World axes", "Of the positions in the file; it is read again with others");
    std::vector<const char*> names(kWorldNames.begin(), kWorldNames.end());
    const auto formats = trajectoryFormats();
    const auto format = std::ranges::find(formats, view.format, &TrajectoryFormat::name);
    std::string usual;
    if (format != formats.end()) {
        usual = fmt::format("{} (usual for the format {})",
                            kWorldNames[1 + static_cast<std::size_t>(format->world)], view.format);
        names.front() = usual.c_str();
    }
    int world = view.world;
    if (choiceCombo("edits.motion.world", world, names)) actions.read_in_world = world;
    endForm();
}

}  // namespace

void keyTimeField(const std::vector<MotionKey>& keys, std::size_t key, const std::string& name,
                  EditRequest& edit) {
    constexpr double kLeast_s = 0.01;  // between keys
    double time_s = keys[key].time_s;
    const double low = key > 0 ? keys[key - 1].time_s + kLeast_s : 0.0;
    const double high = key + 1 < keys.size() ? keys[key + 1].time_s - kLeast_s : kLastMotionTime_s;
    const FieldEdit typed =
        dragNumber(time_s, {std::min(low, time_s), std::max(high, time_s), 0.02F, "%.2f", " s"},
                   name, "Time of the key; drag, or double-click to type");
    if (typed.changed && time_s != keys[key].time_s) {
        edit.operation = {{"op", "change_camera_key"}, {"key", key + 1}, {"time_s", time_s}};
        edit.merge_key = name;
    }
    edit.ends_merge = edit.ends_merge || typed.finished;
}

nlohmann::json removeCameraKeyOperation(std::size_t key) {
    return {{"op", "remove_camera_key"}, {"key", key + 1}};
}

std::span<const char* const> motionWorlds() {
    return kWorlds;
}

MotionActions drawMotionSection(const MotionView& view, MoveDraft& move) {
    MotionActions actions;
    heading("Camera path");
    if (view.motion != nullptr) {
        drawState(view, actions);
        drawKeys(view, actions);
        drawWorld(view, actions);
    } else {
        paragraph(
            "Planned. Keys recorded from views, a path from another program, or a camera "
            "move can take its place.",
            palette().text_dim);
    }
    if (view.busy) {
        ImGui::ProgressBar(static_cast<float>(view.fraction),
                           {scaled(120), ImGui::GetTextLineHeight()}, "");
        ImGui::SameLine();
        ImGui::TextColored(palette().text_dim, "%s", view.stage.c_str());
        if (button("Cancel", "edits.motion.cancel")) actions.cancel = true;
        return actions;
    }
    const bool has_keys = view.motion != nullptr && !view.motion->keys.empty();
    if (button("Add key", "edits.motion.add_key",
               {.why_not = view.why_no_key,
                .tip = "Add the viewport's view as a key frame of the camera path (K)"})) {
        actions.add_key = true;
    }
    if (has_keys) {
        flowTo("Replace key");
        if (button("Replace key", "edits.motion.replace_key",
                   {.why_not = view.why_no_replacing,
                    .tip = "The selected key gets the viewport's view (Shift+K)"})) {
            actions.replace_key = true;
        }
    }
    flowTo("Import \u2026");
    if (button("Import \u2026", "edits.motion.import",
               {.tip = "A trajectory in TUM's, KITTI's, COLMAP's or another format"})) {
        actions.import = true;
    }
    if (view.motion != nullptr) {
        if (!has_keys) flowTo("Repair");
        if (!has_keys &&
            button("Repair", "edits.motion.repair",
                   {.tip = "The nearest path that is collision-free and within the motion "
                           "limits"})) {
            actions.repair = true;
        }
        flowTo("Plan instead");
        if (button("Plan instead", "edits.motion.clear", {.tip = "Remove this path"})) {
            actions.edit.operation = {{"op", "clear_motion"}};
        }
    }
    actions.move = drawMoveForm(view.move, move);
    return actions;
}

}  // namespace dollytrack::ui
