#include "ui/viewport/clip_handles.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

constexpr int kFaces = 6;
constexpr double kThinnest_m = 0.02;
constexpr float kReach_px = 9.0F;

Eigen::Vector3d middleOf(const Eigen::AlignedBox3d& box, int face) {
    Eigen::Vector3d middle = box.center();
    middle[face / 2] = face % 2 == 0 ? box.min()[face / 2] : box.max()[face / 2];
    return middle;
}

/// The face whose handle is under the mouse; -1: none.
int faceUnderMouse(const GizmoView& view, const Eigen::AlignedBox3d& box) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    for (int face = 0; face < kFaces; ++face) {
        const auto at = positionInWindow(view, middleOf(box, face));
        if (at && std::hypot(mouse.x - at->x, mouse.y - at->y) < scaled(kReach_px)) return face;
    }
    return -1;
}

std::optional<double> alongAxis(const GizmoView& view, const ClipHandles& state) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    return nearestAlong(view.view.rayThrough(mouse.x - view.origin.x(), mouse.y - view.origin.y()),
                        state.centre_at_begin, Eigen::Vector3d::Unit(state.dragged / 2));
}

void moveFace(const GizmoView& view, Eigen::AlignedBox3d& box, const ClipHandles& state) {
    const auto along = alongAxis(view, state);
    if (!along) return;
    const int axis = state.dragged / 2;
    const double to = state.centre_at_begin[axis] + *along - state.grabbed_m;
    if (state.dragged % 2 == 0) {
        box.min()[axis] = std::min(to, box.max()[axis] - kThinnest_m);
    } else {
        box.max()[axis] = std::max(to, box.min()[axis] + kThinnest_m);
    }
}

void drawEdges(const GizmoView& view, const Eigen::AlignedBox3d& box, ImU32 color) {
    using Box = Eigen::AlignedBox3d;
    for (int a = 0; a < 8; ++a) {
        for (const int b : {a | 1, a | 2, a | 4}) {
            if (b == a) continue;
            const auto from = positionInWindow(view, box.corner(static_cast<Box::CornerType>(a)));
            const auto to = positionInWindow(view, box.corner(static_cast<Box::CornerType>(b)));
            if (from && to) ImGui::GetWindowDrawList()->AddLine(*from, *to, color, scaled(1.2F));
        }
    }
}

}  // namespace

bool isOnClipHandle(const GizmoView& view, const Eigen::AlignedBox3d& box) {
    return faceUnderMouse(view, box) >= 0;
}

void drawClipHandles(const GizmoView& view, Eigen::AlignedBox3d& box, ClipHandles& state) {
    const int hot = view.hovered ? faceUnderMouse(view, box) : -1;
    if (state.dragged < 0 && hot >= 0 && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        state.dragged = hot;
        state.centre_at_begin = middleOf(box, hot);
        state.grabbed_m = alongAxis(view, state).value_or(0.0);
    }
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) state.dragged = -1;
    if (state.dragged >= 0) moveFace(view, box, state);
    drawEdges(view, box, IM_COL32(255, 255, 255, 110));
    for (int face = 0; face < kFaces; ++face) {
        const auto at = positionInWindow(view, middleOf(box, face));
        if (!at) continue;
        const bool lit = face == (state.dragged >= 0 ? state.dragged : hot);
        ImGui::GetWindowDrawList()->AddCircleFilled(*at, scaled(lit ? 7.0F : 5.0F),
                                                    axisColor(face / 2));
        nameArea(fmt::format("clip.{}.{}", "xyz"[face / 2], face % 2 == 0 ? "low" : "high"),
                 at->x - 3, at->y - 3, at->x + 3, at->y + 3);
    }
}

}  // namespace dollytrack::ui
