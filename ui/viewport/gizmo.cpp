#include "ui/viewport/gizmo.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace dollytrack::ui {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kArrow_px = 78.0;  // length on the screen at any distance
constexpr double kRing_px = 58.0;
constexpr double kGrab_px = 9.0;
constexpr double kClick_px = 2.0;  // tolerated mouse movement during a click

constexpr std::array<ImU32, 3> kAxisColors = {
    IM_COL32(232, 84, 84, 255), IM_COL32(104, 200, 96, 255), IM_COL32(88, 140, 255, 255)};

struct Painter {
    const GizmoView& view;
    double metres_per_px;

    [[nodiscard]] std::optional<ImVec2> at(const Eigen::Vector3d& point) const {
        return positionInWindow(view, point);
    }
};

double metresPerPixel(const GizmoView& view) {
    if (view.view.orthographic) return 1.0 / view.view.orthographic->px_per_m;
    const double depth = std::max(view.view.pose.toCamera(view.pose.position).z(), 0.05);
    return depth / view.view.intrinsics.fx;
}

double distanceToSegment(ImVec2 p, ImVec2 a, ImVec2 b) {
    const Eigen::Vector2f ab(b.x - a.x, b.y - a.y);
    const Eigen::Vector2f ap(p.x - a.x, p.y - a.y);
    const float t = std::clamp(ap.dot(ab) / std::max(ab.squaredNorm(), 1e-6F), 0.0F, 1.0F);
    return (ap - t * ab).norm();
}

double distanceToLine(ImVec2 p, const std::vector<ImVec2>& line) {
    double best = 1e9;
    for (std::size_t i = 1; i < line.size(); ++i) {
        best = std::min(best, distanceToSegment(p, line[i - 1], line[i]));
    }
    return best;
}

double heading(const Eigen::Vector3d& direction) {
    return std::atan2(direction.y(), direction.x());
}

Eigen::Vector3d directionOf(double yaw, double pitch) {
    return {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
}

/// Screen points of the yaw ring, or of the pitch arc through the viewing direction.
std::vector<ImVec2> curve(const Painter& paint, const Pose& pose, GizmoPart part) {
    std::vector<ImVec2> points;
    const double radius = scaled(kRing_px) * paint.metres_per_px;
    const double yaw = heading(pose.forward());
    const int steps = 48;
    for (int i = 0; i <= steps; ++i) {
        const double share = static_cast<double>(i) / steps;
        const Eigen::Vector3d way = part == GizmoPart::Yaw
                                        ? directionOf(2.0 * kPi * share, 0.0)
                                        : directionOf(yaw, (share - 0.5) * 0.9 * kPi);
        if (const auto at = paint.at(pose.position + radius * way)) points.push_back(*at);
    }
    return points;
}

/// Angle at which the mouse ray meets the plane of the ring or arc.
std::optional<double> angleUnder(const render::ViewRay& ray, const Pose& pose, GizmoPart part) {
    const double yaw = heading(pose.forward());
    const Eigen::Vector3d normal = part == GizmoPart::Yaw ? Eigen::Vector3d::UnitZ().eval()
                                                          : directionOf(yaw + 0.5 * kPi, 0.0);
    const double across = ray.direction.dot(normal);
    if (std::abs(across) < 0.05 * ray.direction.norm()) return std::nullopt;
    const double t = (pose.position - ray.origin).dot(normal) / across;
    const Eigen::Vector3d from_centre = ray.origin + t * ray.direction - pose.position;
    if (part == GizmoPart::Yaw) return heading(from_centre);
    const Eigen::Vector3d ahead = directionOf(yaw, 0.0);
    return std::atan2(from_centre.z(), from_centre.dot(ahead));
}

Eigen::Vector3d axisOf(GizmoPart part) {
    return Eigen::Vector3d::Unit(moveAxis(part).value_or(0));
}

render::ViewRay rayUnderMouse(const GizmoView& view) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    return view.view.rayThrough(mouse.x - view.origin.x(), mouse.y - view.origin.y());
}

PoseChange dragged(const GizmoView& view, const GizmoState& state) {
    PoseChange change;
    const Eigen::Vector3d& at = state.begin.position;
    const render::ViewRay ray = rayUnderMouse(view);
    if (moveAxis(state.dragged)) {
        const Eigen::Vector3d axis = axisOf(state.dragged);
        const double along = nearestAlong(ray, at, axis).value_or(state.grabbed);
        change.offset_m = (along - state.grabbed) * axis;
    } else if (state.dragged == GizmoPart::MoveFree) {
        change.offset_m = onScreenPlane(ray, view, at) - state.grabbed_at;
    } else {
        const double angle =
            angleUnder(ray, state.begin, state.dragged).value_or(state.grabbed) - state.grabbed;
        (state.dragged == GizmoPart::Yaw ? change.yaw_rad : change.pitch_rad) = angle;
    }
    return change;
}

void beginDrag(const GizmoView& view, GizmoState& state, GizmoPart part) {
    state.dragged = part;
    state.begin = state.now = view.pose;
    state.pressed_at = {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
    state.pressed_with_ctrl = ImGui::GetIO().KeyCtrl;
    state.pressed_with_alt = ImGui::GetIO().KeyAlt;
    state.moved = false;
    const render::ViewRay ray = rayUnderMouse(view);
    if (part == GizmoPart::MoveFree) {
        state.grabbed_at = onScreenPlane(ray, view, view.pose.position);
    } else if (part == GizmoPart::Yaw || part == GizmoPart::Pitch) {
        state.grabbed = angleUnder(ray, view.pose, part).value_or(0.0);
    } else {
        state.grabbed = nearestAlong(ray, view.pose.position, axisOf(part)).value_or(0.0);
    }
}

/// Positions of the handles on the screen.
struct Handles {
    ImVec2 middle;
    std::array<std::optional<ImVec2>, 3> tips;
    std::array<std::vector<ImVec2>, 2> curves;  // the yaw ring and the pitch arc
};

std::optional<Handles> handlesOf(const GizmoView& view) {
    const Painter paint{view, metresPerPixel(view)};
    const std::optional<ImVec2> middle = paint.at(view.pose.position);
    if (!middle) return std::nullopt;
    Handles handles{*middle, {}, {}};
    const double length = scaled(kArrow_px) * paint.metres_per_px;
    for (int i = 0; i < 3; ++i) {
        handles.tips[i] = paint.at(view.pose.position + length * Eigen::Vector3d::Unit(i));
    }
    if (view.turns) {
        handles.curves[0] = curve(paint, view.pose, GizmoPart::Yaw);
        if (view.tilts) handles.curves[1] = curve(paint, view.pose, GizmoPart::Pitch);
    }
    return handles;
}

GizmoPart handleUnderMouse(const GizmoView& view, const Handles& handles) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    GizmoPart hot = GizmoPart::None;
    double nearest = scaled(kGrab_px);
    const auto consider = [&](GizmoPart part, double distance) {
        if (distance < nearest) {
            nearest = distance;
            hot = part;
        }
    };
    for (int i = 0; i < 3; ++i) {
        if (!handles.tips[i]) continue;
        consider(moveAlong(i), distanceToSegment(mouse, handles.middle, *handles.tips[i]) + 0.5);
    }
    if (view.turns) {
        consider(GizmoPart::Yaw, distanceToLine(mouse, handles.curves[0]));
        consider(GizmoPart::Pitch, distanceToLine(mouse, handles.curves[1]));
    }
    consider(GizmoPart::MoveFree,
             std::hypot(mouse.x - handles.middle.x, mouse.y - handles.middle.y) - 1.0);
    return hot;
}

/// Registers, for each handle, a position at which no other handle overlaps in the item map.
void nameHandles(const GizmoView& view, const Handles& handles) {
    const auto name = [](const char* text, ImVec2 at) {
        nameArea(text, at.x - 3, at.y - 3, at.x + 3, at.y + 3);
    };
    static constexpr std::array<const char*, 3> kAxes = {"gizmo.x", "gizmo.y", "gizmo.z"};
    for (std::size_t i = 0; i < 3; ++i) {
        if (handles.tips[i]) name(kAxes[i], *handles.tips[i]);
    }
    static constexpr std::array<const char*, 2> kTurns = {"gizmo.yaw", "gizmo.pitch"};
    for (std::size_t i = 0; view.turns && i < 2; ++i) {
        if (handles.curves[i].size() >= 7) name(kTurns[i], handles.curves[i][6]);
    }
    name("gizmo.free", handles.middle);
}

}  // namespace

std::optional<ImVec2> positionInWindow(const GizmoView& view, const Eigen::Vector3d& point) {
    constexpr double kNearest_m = 0.01;
    const Eigen::Vector3d p = view.view.pose.toCamera(point);
    if (p.z() <= kNearest_m) return std::nullopt;
    const Eigen::Vector2f pixel = view.view.project(p).cast<float>() + view.origin;
    return ImVec2(pixel.x(), pixel.y());
}

Eigen::Vector3d onScreenPlane(const render::ViewRay& ray, const GizmoView& view,
                              const Eigen::Vector3d& point) {
    const Eigen::Vector3d forward = view.view.pose.forward();
    return ray.origin +
           (point - ray.origin).dot(forward) / ray.direction.dot(forward) * ray.direction;
}

std::optional<Eigen::Vector3d> onPlane(const render::ViewRay& ray, const Eigen::Vector3d& point,
                                       const Eigen::Vector3d& normal) {
    constexpr double kParallel = 0.01;  // a plane seen edge-on would follow the mouse wildly
    const double towards = ray.direction.normalized().dot(normal);
    const double away = (point - ray.origin).dot(normal);
    if (std::abs(towards) < kParallel || away * towards <= 0.0) return std::nullopt;
    return ray.origin + away / towards * ray.direction.normalized();
}

unsigned axisColor(int axis) {
    return kAxisColors[axis];
}

std::optional<double> nearestAlong(const render::ViewRay& ray, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& axis) {
    const Eigen::Vector3d direction = ray.direction.normalized();
    const double slant = direction.dot(axis);
    const double square = 1.0 - slant * slant;
    if (square < 1e-4) return std::nullopt;
    const Eigen::Vector3d between = ray.origin - origin;
    return (between.dot(axis) - slant * between.dot(direction)) / square;
}

bool isOnGizmo(const GizmoView& view) {
    const std::optional<Handles> handles = handlesOf(view);
    return handles && handleUnderMouse(view, *handles) != GizmoPart::None;
}

GizmoActions drawGizmo(const GizmoView& view, GizmoState& state) {
    GizmoActions actions;
    actions.pose = view.pose;
    const std::optional<Handles> handles = handlesOf(view);
    if (!handles) return actions;
    const auto& [middle, tips, curves] = *handles;
    nameHandles(view, *handles);
    GizmoPart hot = handleUnderMouse(view, *handles);
    if (!view.hovered && state.dragged == GizmoPart::None) hot = GizmoPart::None;
    if (state.dragged == GizmoPart::None && hot != GizmoPart::None &&
        ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        beginDrag(view, state, hot);
    }
    if (state.dragged != GizmoPart::None) {
        hot = state.dragged;
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
            const ImGuiIO& io = ImGui::GetIO();
            const double way = std::hypot(io.MousePos.x - state.pressed_at.x(),
                                          io.MousePos.y - state.pressed_at.y());
            state.moved = state.moved || way > scaled(kClick_px);
            if (state.moved) {
                actions.steps = snapSteps(io.KeyCtrl, io.KeyShift);
                actions.change = snapped(state.dragged, {}, dragged(view, state), actions.steps)
                                     .appliedTo(state.begin);
                actions.pose = actions.change.of(state.begin);
                actions.changed = !(actions.pose == state.now);
                state.now = actions.pose;
            }
        } else {
            state.dragged = GizmoPart::None;
            actions.finished = true;
            actions.clicked = !state.moved;
            actions.with_ctrl = state.pressed_with_ctrl;
            actions.with_alt = state.pressed_with_alt;
        }
    }

    ImDrawList* list = ImGui::GetWindowDrawList();
    const auto width = [&](GizmoPart part) { return scaled(part == hot ? 4.0F : 2.2F); };
    if (view.turns) {
        const std::array<GizmoPart, 2> parts = {GizmoPart::Yaw, GizmoPart::Pitch};
        for (std::size_t i = 0; i < 2; ++i) {
            list->AddPolyline(curves[i].data(), static_cast<int>(curves[i].size()),
                              i == 0 ? IM_COL32(255, 214, 70, 230) : IM_COL32(210, 120, 255, 230),
                              ImDrawFlags_None, width(parts[i]));
        }
    }
    for (int i = 0; i < 3; ++i) {
        if (!tips[i]) continue;
        const GizmoPart part = moveAlong(i);
        list->AddLine(middle, *tips[i], kAxisColors[i], width(part));
        list->AddCircleFilled(*tips[i], scaled(part == hot ? 7.0F : 5.5F), kAxisColors[i]);
    }
    list->AddCircleFilled(middle, scaled(hot == GizmoPart::MoveFree ? 8.0F : 6.0F),
                          IM_COL32(255, 255, 255, 230));
    list->AddCircle(middle, scaled(6.0F), IM_COL32(0, 0, 0, 160));
    return actions;
}

}  // namespace dollytrack::ui
