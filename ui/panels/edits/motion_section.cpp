#include "ui/panels/edits/motion_section.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/fields/choice_combo.h"
#include "ui/widgets/form.h"

#include <fmt/format.h>
#include <imgui.h>

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
    cutText(motion.name.empty() ? "Without a name" : motion.name,
            ImGui::GetStyleColorVec4(ImGuiCol_Text),
            fmt::format("{} frames, {:.1f} s", motion.frames.size(),
                        motion.frames.back().time_s - motion.frames.front().time_s),
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

std::span<const char* const> motionWorlds() {
    return kWorlds;
}

MotionActions drawMotionSection(const MotionView& view) {
    MotionActions actions;
    heading("Camera path");
    if (view.motion != nullptr) {
        drawState(view);
        drawWorld(view, actions);
    } else {
        paragraph("Planned. A path from another program, or a camera move, can take its place.",
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
    if (button("Import \u2026", "edits.motion.import",
               {.tip = "A trajectory in TUM's, KITTI's, COLMAP's or another format"})) {
        actions.import = true;
    }
    if (view.motion != nullptr) {
        flowTo("Repair");
        if (button(
                "Repair", "edits.motion.repair",
                {.tip = "The nearest path that is collision-free and within the motion limits"})) {
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
