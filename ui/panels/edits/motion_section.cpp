#include "ui/panels/edits/motion_section.h"

#include "planning/motions/key_motion.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/fields/choice_combo.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/form.h"
#include "ui/widgets/icon_button.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace dollytrack::ui {
namespace {

constexpr std::array kWorlds = {"", "scene", "y-up", "z-up", "ned", "camera"};
constexpr std::array kWorldNames = {
    "Usual for the format",       "Axes and unit of the scene file", "m, y up", "m, z up",
    "m, north, east, down (NED)", "m, right, down, forward"};

struct Move {
    const char* label;
    const char* kind;
    bool needs_object;
    const char* tip;
};
constexpr std::array kMoves = {
    Move{"Orbit", "orbit", true, "Around the selected object"},
    Move{"Arc", "arc", true, "A quarter of an orbit around the selected object"},
    Move{"Dolly", "dolly", true, "Straight towards the selected object"},
    Move{"Crane", "crane", true, "Upwards in front of the selected object"},
    Move{"Walk", "walk", false, "Through the doorways of all rooms, looking ahead"},
};

void drawState(const MotionView& view) {
    const GivenMotion& motion = *view.motion;
    const bool has_keys = !motion.keys.empty();
    const std::string nameless =
        has_keys ? fmt::format("{} key{}, {:.1f} s", motion.keys.size(),
                               motion.keys.size() == 1 ? "" : "s", motion.duration_s())
                 : "Without a name";
    cutText(motion.name.empty() ? nameless : motion.name, ImGui::GetStyleColorVec4(ImGuiCol_Text),
            fmt::format("{} {}, {:.1f} s", has_keys ? motion.keys.size() : motion.frames.size(),
                        has_keys ? "keys" : "frames", motion.duration_s()),
            Cut::Middle);
    if (view.plan == nullptr) {
        if (view.plan_error.empty()) {
            ImGui::TextColored(palette().text_dim, "being checked \u2026");
        } else {
            paragraph("Not checked: planning failed.", palette().bad);
        }
        return;
    }
    int collisions = 0;
    std::size_t segments = 0;
    for (const SmoothPath& path : view.plan->smooth_paths) {
        collisions += path.collisions;
        segments += path.pieces.size();
    }
    if (collisions == 0) {
        ImGui::TextColored(palette().good, "\u25cf free of collisions");
    } else {
        paragraph(
            fmt::format("\u25cb {} of {} segments between frames collide", collisions, segments),
            palette().bad);
    }
    if (!view.change.empty()) paragraph(view.change, palette().text_dim);
}

/// One row for each key, and what the plan could not keep of it.
void drawKeys(const MotionView& view, MotionActions& actions) {
    const std::vector<MotionKey>& keys = view.motion->keys;
    const bool checked = view.plan != nullptr && view.plan->passed_keys.size() == keys.size();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::string name = fmt::format("edits.motion.key.{}", i);
        ImGui::PushID(static_cast<int>(i));
        const bool selected = view.selected_key == static_cast<int>(i);
        ImGui::AlignTextToFramePadding();
        if (link(fmt::format("{}Key {}", selected ? "\u25cf " : "", i + 1), name + ".select",
                 "Select it; K then replaces it by the view")) {
            actions.select_key = static_cast<int>(i);
        }
        ImGui::SameLine(scaled(66));
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
        if (checked && !view.plan->passed_keys[i].note.empty()) {
            paragraph(view.plan->passed_keys[i].note, palette().bad);
        }
        ImGui::PopID();
    }
    if (keys.size() == 1) {
        paragraph("Fly on in the viewport and press K for the next key.", palette().text_dim);
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
    int world = view.world;
    if (choiceCombo("edits.motion.world", world, kWorldNames)) actions.read_in_world = world;
    endForm();
}

void drawMoves(const MotionView& view, MotionActions& actions) {
    ImGui::TextColored(palette().text_dim, "Make a camera move");
    bool first = true;
    for (const Move& move : kMoves) {
        if (!first) flowTo(move.label);
        first = false;
        const bool lacks_object = move.needs_object && !view.has_object;
        const char* why_not = !view.has_scene ? "No scene is open."
                              : lacks_object  ? "Select one object first."
                                              : "";
        if (button(move.label, fmt::format("edits.motion.{}", move.kind),
                   {.why_not = why_not, .tip = move.tip})) {
            actions.make = move.kind;
        }
    }
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

MotionActions drawMotionSection(const MotionView& view) {
    MotionActions actions;
    heading("Camera path");
    if (view.motion != nullptr) {
        drawState(view);
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
    drawMoves(view, actions);
    return actions;
}

}  // namespace dollytrack::ui
