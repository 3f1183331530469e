#include "ui/panels/timeline/camera_keys.h"

#include "planning/motions/key_motion.h"
#include "ui/panels/timeline/timeline_time.h"
#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

constexpr float kDragFrom_px = 3.0F;    // a shorter way of the mouse is a click
constexpr double kMarginShare = 0.15;   // of the trajectory
constexpr double kLeastMargin_s = 2.0;  // but at least this

const std::vector<TimelineCameraKey>& keysOf(const TimelineView& view) {
    static const std::vector<TimelineCameraKey> none;
    return view.camera_keys != nullptr ? *view.camera_keys : none;
}

double secondsPerFrame(const TimelineView& view) {
    return view.frame_interval_s > 0.0 ? view.frame_interval_s : 1.0;
}

double xOf(const TimelineView& view, const FrameAxis& axis, double time_s) {
    return axis.xOf(frameAt(view, time_s) + 0.5);
}

/// The key under the mouse; of several, the nearest. -1: none.
int keyUnder(const TimelineView& view, const FrameAxis& axis, const CameraKeyRow& row) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (mouse.y < row.top || mouse.y >= row.bottom) return -1;
    int nearest = -1;
    double least = scaled(8);
    for (std::size_t i = 0; i < keysOf(view).size(); ++i) {
        const double distance = std::abs(xOf(view, axis, keysOf(view)[i].time_s) - mouse.x);
        if (distance >= least) continue;
        least = distance;
        nearest = static_cast<int>(i);
    }
    return nearest;
}

/// Follows the pressed key until it is let go.
void dragKey(const TimelineView& view, const FrameAxis& axis, bool active, TimelineState& state,
             TimelineActions& actions) {
    const int key = state.pressed_key;
    const double before_s = keysOf(view)[static_cast<std::size_t>(key)].time_s;
    if (!active) {
        if (state.dragged_to_s && *state.dragged_to_s != before_s) {
            actions.retime = {key, *state.dragged_to_s};
        }
        state.pressed_key = -1;
        state.dragged_to_s.reset();
        return;
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
        state.pressed_key = -1;
        state.dragged_to_s.reset();
        state.drag_cancelled = true;
        return;
    }
    if (!state.dragged_to_s &&
        !ImGui::IsMouseDragging(ImGuiMouseButton_Left, scaled(kDragFrom_px))) {
        return;
    }
    const double place = axis.placeAt(ImGui::GetIO().MousePos.x - state.grip_px) - 0.5;
    state.dragged_to_s = keyTimeNear(view, key, timeOf(view, place));
}

void drawDiamond(ImVec2 at, float r, ImU32 color, bool filled) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 a(at.x, at.y - r);
    const ImVec2 b(at.x + r, at.y);
    const ImVec2 c(at.x, at.y + r);
    const ImVec2 d(at.x - r, at.y);
    if (filled) {
        list->AddQuadFilled(a, b, c, d, color);
        list->AddQuad(a, b, c, d, IM_COL32(0, 0, 0, 140));
    } else {
        list->AddQuad(a, b, c, d, color, scaled(1.5F));
    }
}

void drawKeyTooltip(const TimelineView& view, const TimelineState& state, int key) {
    const TimelineCameraKey& one = keysOf(view)[static_cast<std::size_t>(key)];
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(scaled(360));
    if (state.dragged_to_s) {
        ImGui::Text("Key %d: %.2f s, was %.2f s", key + 1, *state.dragged_to_s, one.time_s);
        ImGui::TextColored(palette().text_dim, "Esc: cancel");
    } else {
        ImGui::Text("Key %d, %.2f s", key + 1, one.time_s);
        if (!one.note.empty()) ImGui::TextColored(palette().bad, "%s", one.note.c_str());
        ImGui::TextColored(palette().text_dim,
                           "Drag: retime   Double click: fly there   Del: remove");
    }
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

bool hasCameraKeys(const TimelineView& view) {
    return !keysOf(view).empty();
}

double cameraKeyMargin(const TimelineView& view) {
    if (!hasCameraKeys(view)) return 0.0;
    const double last_s = keysOf(view).back().time_s;
    const double behind = std::max(frameAt(view, last_s) + 1.0 - view.frame_count, 0.0);
    return behind + std::max(std::ceil(kMarginShare * view.frame_count),
                             std::ceil(kLeastMargin_s / secondsPerFrame(view)));
}

double keyTimeNear(const TimelineView& view, int key, double time_s) {
    const std::vector<TimelineCameraKey>& keys = keysOf(view);
    const auto at = static_cast<std::size_t>(key);
    const double step = secondsPerFrame(view);
    const double low = at > 0 ? keys[at - 1].time_s + step : 0.0;
    const double wanted = std::round(time_s / step) * step;
    const double high = at + 1 < keys.size() ? keys[at + 1].time_s - step : wanted;
    if (at + 1 < keys.size() && high < low) return keys[at].time_s;
    // Without the rounding errors of the multiplication.
    return std::round(1e6 * std::clamp(wanted, low, std::max(low, high))) / 1e6;
}

bool editCameraKeys(const TimelineView& view, const FrameAxis& axis, const CameraKeyRow& row,
                    TimelineState& state, TimelineActions& actions) {
    state.drag_cancelled = state.drag_cancelled && row.active;
    if (state.drag_cancelled) return true;
    const auto count = static_cast<int>(keysOf(view).size());
    if (state.pressed_key >= count) state.pressed_key = -1;
    if (state.pressed_key < 0) state.dragged_to_s.reset();
    if (state.pressed_key >= 0) {
        dragKey(view, axis, row.active, state, actions);
        return true;
    }
    // A press that began elsewhere goes on selecting frames, also over a key.
    const bool clicked = row.active && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    const int under = row.hovered && (clicked || !row.active) ? keyUnder(view, axis, row) : -1;
    if (under < 0) return false;
    const TimelineCameraKey& key = keysOf(view)[static_cast<std::size_t>(under)];
    if (clicked) {
        state.pressed_key = under;
        state.grip_px = ImGui::GetIO().MousePos.x - xOf(view, axis, key.time_s);
        actions.select_key = under;
        actions.go_to = std::clamp(static_cast<int>(std::lround(frameAt(view, key.reached_s))), 0,
                                   view.frame_count - 1);
    }
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) actions.fly_to_key = under;
    return true;
}

void drawCameraKeys(const TimelineView& view, const TimelineState& state, const FrameAxis& axis,
                    const CameraKeyRow& row) {
    const float r = scaled(5);
    const float y = std::floor((row.top + row.bottom) / 2) - scaled(1);
    for (std::size_t i = 0; i < keysOf(view).size(); ++i) {
        const TimelineCameraKey& key = keysOf(view)[i];
        const bool dragged = state.pressed_key == static_cast<int>(i) && state.dragged_to_s;
        const double time_s = dragged ? *state.dragged_to_s : key.time_s;
        const auto x = static_cast<float>(xOf(view, axis, time_s));
        const auto reached = static_cast<float>(xOf(view, axis, key.reached_s));
        const ImU32 color =
            ImGui::GetColorU32(key.note.empty() ? palette().warning : palette().bad);
        const bool late =
            !dragged && planning::isLate(key.reached_s - time_s, secondsPerFrame(view));
        if (late && reached <= axis.right()) {
            ImGui::GetWindowDrawList()->AddLine({x, y}, {reached, y}, color, scaled(1.5F));
            drawDiamond({reached, y}, scaled(4), color, false);
        }
        if (x < axis.left() - r || x > axis.right() + r) continue;
        const bool selected = view.selected_key == static_cast<int>(i);
        drawDiamond({x, y}, selected ? scaled(6) : r,
                    selected ? ImGui::GetColorU32(palette().accent) : color, true);
        nameArea(fmt::format("timeline.camera_key.{}", i), x - r, y - r, x + r, y + r);
    }
    const int shown = state.pressed_key >= 0 ? state.pressed_key
                      : row.hovered          ? keyUnder(view, axis, row)
                                             : -1;
    if (shown >= 0) drawKeyTooltip(view, state, shown);
}

}  // namespace dollytrack::ui
