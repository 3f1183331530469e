#include "ui/viewport/key_transform.h"

#include "ui/theme.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

namespace dollytrack::ui {
namespace {

// Larger numbers are slips of the finger: 1 km is more than any building.
constexpr double kLargestNumber = 1000.0;
constexpr std::size_t kMostCharacters = 12;

/// The number of values that can be typed.
std::size_t fieldCount(const KeyTransform& keys) {
    return std::max<std::size_t>(axesOf(keys.part).size(), 1);
}

void chooseAxis(KeyTransform& keys, int axis, bool tilts, bool locks) {
    if (keys.turns()) {
        if (axis == 2) keys.part = GizmoPart::Yaw;
        if (axis == 0 && tilts) keys.part = GizmoPart::Pitch;
        return;
    }
    const GizmoPart wanted = locks ? moveWithout(axis) : moveAlong(axis);
    if (keys.part != wanted) {
        keys.part = wanted;
        keys.own_axes = false;
    } else if (!keys.own_axes) {
        keys.own_axes = true;
    } else {
        keys.part = GizmoPart::MoveFree;
        keys.own_axes = false;
    }
    for (std::size_t i = fieldCount(keys); i < keys.typed.size(); ++i) keys.typed[i].clear();
    keys.field = std::min(keys.field, fieldCount(keys) - 1);
}

/// The angle by which the mouse has turned around the element on the screen, as a rotation about
/// the axis.
double angleAround(const Eigen::Vector3d& axis, const GizmoView& view, const Eigen::Vector3d& at,
                   const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector3d in_camera = view.view.pose.toCamera(at);
    if (in_camera.z() <= 0.0) return 0.0;
    const Eigen::Vector2d middle = view.view.project(in_camera);
    const auto angle = [&](const Eigen::Vector2d& p) {
        return std::atan2(middle.y() - p.y(), p.x() - middle.x());
    };
    const bool towards_viewer = axis.dot(view.view.pose.position - at) >= 0.0;
    return (towards_viewer ? 1.0 : -1.0) *
           std::remainder(angle(to) - angle(from), 2.0 * std::numbers::pi);
}

Eigen::Vector3d offsetOfMouse(const KeyTransform& keys, const GizmoView& view,
                              const Eigen::Vector2d& cursor) {
    const Eigen::Vector3d at = keys.begin->position;
    const auto ray = [&](const Eigen::Vector2d& p) { return view.view.rayThrough(p.x(), p.y()); };
    const render::ViewRay from = ray(keys.cursor_at_begin);
    const render::ViewRay to = ray(cursor);
    if (const auto axis = moveAxis(keys.part)) {
        const Eigen::Vector3d way = MoveAxes{view.heading_rad, keys.own_axes}.direction(*axis);
        const auto before = nearestAlong(from, at, way);
        const auto now = nearestAlong(to, at, way);
        return before && now ? Eigen::Vector3d((*now - *before) * way) : Eigen::Vector3d::Zero();
    }
    if (const auto locked = lockedAxis(keys.part)) {
        const Eigen::Vector3d normal = MoveAxes{view.heading_rad, keys.own_axes}.direction(*locked);
        const auto before = onPlane(from, at, normal);
        const auto now = onPlane(to, at, normal);
        return before && now ? Eigen::Vector3d(*now - *before) : Eigen::Vector3d::Zero();
    }
    return onScreenPlane(to, view, at) - onScreenPlane(from, view, at);
}

/// Draws a line through the element along an axis of the move.
void drawAxis(const KeyTransform& keys, const GizmoView& view, int axis) {
    constexpr double kHalfLength_m = 50.0;
    constexpr int kSteps = 200;  // short pieces: those behind the camera are left out
    const Eigen::Vector3d way = MoveAxes{view.heading_rad, keys.own_axes}.direction(axis);
    std::optional<ImVec2> last;
    for (int i = -kSteps; i <= kSteps; ++i) {
        const std::optional<ImVec2> at =
            positionInWindow(view, keys.begin->position + kHalfLength_m * i / kSteps * way);
        if (last && at) {
            ImGui::GetWindowDrawList()->AddLine(*last, *at, axisColor(axis), scaled(1.4F));
        }
        last = at;
    }
}

}  // namespace

bool KeyTransform::hasNumber() const {
    return std::ranges::any_of(typed, [](const std::string& one) { return !one.empty(); });
}

void typeCharacter(KeyTransform& keys, char character, bool tilts, bool shift) {
    const char small = static_cast<char>(character | 0x20);
    if (small >= 'x' && small <= 'z') return chooseAxis(keys, small - 'x', tilts, shift);
    if (character == '\t') {
        keys.field = (keys.field + 1) % fieldCount(keys);
        return;
    }
    std::string& typed = keys.typed[keys.field];
    if (character == '-') {
        if (typed.starts_with('-')) {
            typed.erase(0, 1);
        } else {
            typed.insert(0, 1, '-');
        }
        return;
    }
    const bool point = character == '.' || character == ',';
    if (point ? typed.find('.') != std::string::npos : character < '0' || character > '9') return;
    const std::string before = typed;
    typed += point ? '.' : character;
    if (typed.size() > kMostCharacters ||
        std::abs(*typedNumber(keys, keys.field)) > kLargestNumber) {
        typed = before;
    }
}

void eraseCharacter(KeyTransform& keys) {
    std::string& typed = keys.typed[keys.field];
    if (!typed.empty()) typed.pop_back();
}

std::optional<double> typedNumber(const KeyTransform& keys, std::size_t field) {
    const std::string& typed = keys.typed[field];
    if (typed.empty()) return std::nullopt;
    double number = 0.0;
    std::from_chars(typed.data(), typed.data() + typed.size(), number);
    return number;
}

PoseChange changeOf(const KeyTransform& keys, const GizmoView& view,
                    const Eigen::Vector2d& cursor) {
    PoseChange change;
    if (!keys.turns()) {
        if (!keys.hasNumber()) {
            change.offset_m = offsetOfMouse(keys, view, cursor);
            return change;
        }
        const MoveAxes axes = {view.heading_rad, keys.own_axes};
        std::size_t field = 0;
        for (const int axis : axesOf(keys.part)) {
            change.offset_m += typedNumber(keys, field++).value_or(0.0) * axes.direction(axis);
        }
        return change;
    }
    const std::optional<double> number = typedNumber(keys);
    const bool pitch = keys.part == GizmoPart::Pitch;
    const Eigen::Vector3d axis =
        pitch ? Eigen::Vector3d(keys.begin->rotation * Eigen::Vector3d::UnitX())
              : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
    const double angle =
        number ? *number * std::numbers::pi / 180.0
               : angleAround(axis, view, keys.begin->position, keys.cursor_at_begin, cursor);
    (pitch ? change.pitch_rad : change.yaw_rad) = angle;
    return change;
}

GizmoActions followKeys(KeyTransform& keys, const GizmoView& view) {
    const ImGuiIO& io = ImGui::GetIO();
    const Eigen::Vector2d cursor(io.MousePos.x - view.origin.x(), io.MousePos.y - view.origin.y());
    if (!keys.begin) {
        keys.begin = keys.now = view.pose;
        keys.cursor_at_begin = cursor;
    }
    for (const ImWchar character : io.InputQueueCharacters) {
        if (character < 128) {
            typeCharacter(keys, static_cast<char>(character), view.tilts, io.KeyShift);
        }
    }
    if (ImGui::IsKeyPressed(GLFW_KEY_TAB)) typeCharacter(keys, '\t', view.tilts);
    if (ImGui::IsKeyPressed(GLFW_KEY_BACKSPACE)) eraseCharacter(keys);
    const std::vector<int> axes = axesOf(keys.part);
    if (axes.size() < 3) {
        for (const int axis : axes) drawAxis(keys, view, axis);
    }
    GizmoActions actions;
    actions.change = changeOf(keys, view, cursor);
    if (!keys.hasNumber()) {
        actions.steps = snapSteps(io.KeyCtrl, io.KeyShift);
        actions.change =
            snapped(keys.part, {view.heading_rad, keys.own_axes}, actions.change, actions.steps);
    }
    actions.change = actions.change.appliedTo(*keys.begin);
    actions.pose = actions.change.of(*keys.begin);
    actions.changed = !(actions.pose == keys.now);
    keys.now = actions.pose;
    actions.finished = ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) ||
                       ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false) ||
                       ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    return actions;
}

}  // namespace dollytrack::ui
