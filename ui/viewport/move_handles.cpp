#include "ui/viewport/move_handles.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::ui {
namespace {

using Eigen::Vector3d;

constexpr float kHandleReach_px = 9.0F;
constexpr ImU32 kColor = IM_COL32(255, 255, 255, 255);  // no other path is white
constexpr double kFull_rad = 2.0 * std::numbers::pi;

double headingFrom(const Vector3d& center, const Vector3d& at) {
    return std::atan2(at.y() - center.y(), at.x() - center.x());
}

/// The angle that a path turns about a point, counter-clockwise, rad.
double sweptAngle(const std::vector<Vector3d>& path, const Vector3d& center) {
    double swept = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        swept += std::remainder(headingFrom(center, path[i]) - headingFrom(center, path[i - 1]),
                                kFull_rad);
    }
    return swept;
}

/// How far the mouse moved along a direction at the handle, m.
double movedAlong(const MoveDrag& drag, const render::ViewRay& ray, const Vector3d& direction) {
    const auto before = nearestAlong(drag.ray, drag.handle.at, direction);
    const auto now = nearestAlong(ray, drag.handle.at, direction);
    return before && now ? *now - *before : 0.0;
}

/// How far it moved in the horizontal plane of the handle, m.
Vector3d movedLevel(const MoveDrag& drag, const render::ViewRay& ray) {
    const auto before = onPlane(drag.ray, drag.handle.at, Vector3d::UnitZ());
    const auto now = onPlane(ray, drag.handle.at, Vector3d::UnitZ());
    return before && now ? Vector3d(*now - *before) : Vector3d::Zero();
}

double draggedArc_deg(const MoveDrag& drag, const render::ViewRay& ray) {
    const Vector3d& center = *drag.preview.look_at;
    const double swept = sweptAngle(drag.preview.path, center);
    const Vector3d end = drag.handle.at + movedLevel(drag, ray);
    const double turned =
        std::remainder(headingFrom(center, end) - headingFrom(center, drag.handle.at), kFull_rad);
    // The arc grows at both ends.
    return (std::abs(swept) + 2.0 * std::copysign(1.0, swept) * turned) * 360.0 / kFull_rad;
}

/// The value of a number after the drag.
double draggedNumber(const MoveDrag& drag, const render::ViewRay& ray) {
    const Vector3d& at = drag.handle.at;
    if (drag.handle.setting == "arc") return draggedArc_deg(drag, ray);
    if (drag.handle.setting == "radius") {
        Vector3d out = at - *drag.preview.look_at;
        out.z() = 0.0;
        return out.norm() + movedAlong(drag, ray, out.normalized());
    }
    return at.z() + movedAlong(drag, ray, Vector3d::UnitZ()) - drag.preview.floor_z;
}

const planning::MoveSetting* settingOf(const MoveDrag& drag) {
    const planning::MoveKind* kind = planning::findMoveKind(drag.move.kind);
    if (kind == nullptr) return nullptr;
    const auto found =
        std::ranges::find(kind->settings, drag.handle.setting, &planning::MoveSetting::name);
    return found == kind->settings.end() ? nullptr : &*found;
}

/// The handles without those that would move along the viewing direction.
std::vector<MoveHandle> usableHandles(const GizmoView& view, const planning::MoveRequest& move,
                                      const MovePreview& preview) {
    constexpr double kSteepest = 0.94;  // 20 degrees from the vertical
    std::vector<MoveHandle> handles = moveHandles(move, preview);
    if (std::abs(view.view.pose.forward().z()) > kSteepest) {
        std::erase_if(handles,
                      [](const MoveHandle& handle) { return handle.setting.ends_with("height"); });
    }
    return handles;
}

const MoveHandle* handleUnderMouse(const GizmoView& view, const std::vector<MoveHandle>& handles) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    for (const MoveHandle& handle : handles) {
        const auto at = positionInWindow(view, handle.at);
        if (at && std::hypot(mouse.x - at->x, mouse.y - at->y) < scaled(kHandleReach_px))
            return &handle;
    }
    return nullptr;
}

void drawPath(const GizmoView& view, const std::vector<Vector3d>& path) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const auto draw = [&](ImU32 line_color, float width) {
        std::optional<ImVec2> last;
        for (const Vector3d& point : path) {
            const auto at = positionInWindow(view, point);
            if (last && at) list->AddLine(*last, *at, line_color, scaled(width));
            last = at;
        }
    };
    draw(IM_COL32(0, 0, 0, 200), 6.0F);  // an outline, to be seen on bright surfaces
    draw(kColor, 3.0F);
}

void drawHandle(const GizmoView& view, const planning::MoveRequest& move, const MoveHandle& handle,
                bool lit) {
    const auto at = positionInWindow(view, handle.at);
    if (!at) return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddCircleFilled(*at, scaled(lit ? 8.0F : 6.0F), IM_COL32(0, 0, 0, 255));
    list->AddCircleFilled(*at, scaled(lit ? 6.5F : 4.5F),
                          lit ? ImGui::GetColorU32(palette().accent) : kColor);
    nameArea("move." + handle.setting, at->x - 3, at->y - 3, at->x + 3, at->y + 3);
    if (!lit) return;
    std::string text = planning::settingLabel(handle.setting);
    const auto value = move.options.find(handle.setting);
    if (value != move.options.end()) text += " " + value->second;
    const ImVec2 corner(at->x + scaled(12), at->y - scaled(9));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float margin = scaled(3);
    list->AddRectFilled({corner.x - margin, corner.y - margin},
                        {corner.x + size.x + margin, corner.y + size.y + margin},
                        IM_COL32(0, 0, 0, 190), margin);
    list->AddText(corner, IM_COL32(255, 255, 255, 255), text.c_str());
}

}  // namespace

std::vector<MoveHandle> moveHandles(const planning::MoveRequest& move, const MovePreview& preview) {
    const std::vector<Vector3d>& path = preview.path;
    if (path.size() < 2) return {};
    const Vector3d& middle = path[path.size() / 2];
    std::vector<MoveHandle> handles;
    const bool turns = move.kind == "orbit" || move.kind == "arc";
    if ((turns || move.kind == "crane") && preview.look_at) {
        handles.push_back({"radius", middle});
        if (!preview.has_subject) handles.push_back({"center", *preview.look_at});
    }
    if (turns) {
        handles.push_back({"height", path[path.size() / 4]});
        if (preview.look_at) handles.push_back({"arc", path.back()});
    } else if (move.kind == "crane") {
        handles.push_back({"from_height", path.front()});
        handles.push_back({"to_height", path.back()});
    } else {
        handles.push_back({"from", path.front()});
        handles.push_back({"to", path.back()});
        if (move.kind == "walk" && !move.options.contains("from")) {
            handles.push_back({"height", middle});
        }
    }
    return handles;
}

planning::MoveOptions draggedOptions(const MoveDrag& drag, const render::ViewRay& ray) {
    planning::MoveOptions options = drag.move.options;
    const planning::MoveSetting* setting = settingOf(drag);
    if (setting == nullptr) return options;
    if (setting->kind == planning::MoveSetting::Kind::Number) {
        const double value =
            std::clamp<double>(draggedNumber(drag, ray), setting->info.min, setting->info.max);
        options[drag.handle.setting] = planning::optionText(value);
        return options;
    }
    if (drag.handle.setting != "center" && !(options.contains("from") && options.contains("to"))) {
        // Both ends are given from now on, and still the same point is looked at.
        options.try_emplace("from", planning::optionText(drag.preview.path.front()));
        options.try_emplace("to", planning::optionText(drag.preview.path.back()));
        if (drag.move.kind == "dolly" && drag.preview.look_at && !options.contains("target")) {
            options["center"] = planning::optionText(*drag.preview.look_at);
        }
    }
    options[drag.handle.setting] = planning::optionText(drag.handle.at + movedLevel(drag, ray));
    return options;
}

bool isOnMoveHandle(const GizmoView& view, const planning::MoveRequest& move,
                    const MovePreview& preview) {
    return handleUnderMouse(view, usableHandles(view, move, preview)) != nullptr;
}

bool drawMoveHandles(const GizmoView& view, const MovePreview& preview, planning::MoveRequest& move,
                     std::optional<MoveDrag>& drag) {
    const std::vector<MoveHandle> handles = usableHandles(view, move, preview);
    const MoveHandle* hot = view.hovered ? handleUnderMouse(view, handles) : nullptr;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const render::ViewRay ray =
        view.view.rayThrough(mouse.x - view.origin.x(), mouse.y - view.origin.y());
    if (!drag && hot != nullptr && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        drag = MoveDrag{*hot, move, preview, ray};
    }
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) drag.reset();
    bool changed = false;
    const ImVec2 way = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, scaled(2.0F));
    if (drag && (way.x != 0.0F || way.y != 0.0F)) {
        planning::MoveOptions options = draggedOptions(*drag, ray);
        changed = options != move.options;
        move.options = std::move(options);
    }
    drawPath(view, preview.path);
    for (const MoveHandle& handle : handles) {
        const bool dragged = drag && drag->handle.setting == handle.setting;
        drawHandle(view, move, handle, dragged || (!drag && &handle == hot));
    }
    return changed;
}

}  // namespace dollytrack::ui
