#include "ui/widgets/fields/drag_fields.h"

#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <cmath>
#include <numbers>

namespace dollytrack::ui {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

void merge(FieldEdit& all, const FieldEdit& one) {
    all.changed = all.changed || one.changed;
    all.finished = all.finished || one.finished;
}

}  // namespace

FieldEdit dragNumber(double& value, const DragRange& range, const std::string& name,
                     const std::string& tip) {
    NumberLimits limits;
    limits.range = {range.min, range.max};
    limits.format = range.format;
    limits.unit = range.unit;
    limits.slides = false;
    limits.speed = range.speed;
    const FieldEdit edit = numberInput(value, limits, name);
    if (!edit.says && !ImGui::IsItemActive()) tooltip(tip);
    return edit;
}

FieldEdit dragPoint(Eigen::Vector3d& point, const DragRange& range, const std::string& name,
                    const std::string& tip, float spare) {
    FieldEdit edit;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - spare - 2 * gap) / 3;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) ImGui::SameLine(0, gap);
        ImGui::SetNextItemWidth(width);
        merge(edit, dragNumber(point[axis], range, name + "." + "xyz"[axis], tip));
    }
    return edit;
}

BoxEdit boxRows(OrientedBox& box, const std::string& name) {
    BoxEdit edit;
    formLabel("Centre", "x, y, z in m");
    edit.center =
        dragPoint(box.center, kPlaceRange, name + ".center", "m; drag, or double-click to type");
    formLabel("Size", "Along its own axes, in m");
    Eigen::Vector3d size = 2.0 * box.half_size;
    edit.size = dragPoint(size, kLengthRange, name + ".size", "m; drag, or double-click to type");
    if (edit.size.changed) box.half_size = 0.5 * size;
    formLabel("Turned", "About the vertical");
    double yaw = box.yaw * kDegrees;
    edit.yaw = dragNumber(yaw, kAngleRange, name + ".yaw");
    if (edit.yaw.changed) box.yaw = wrapDegrees(yaw) / kDegrees;
    return edit;
}

double wrapDegrees(double angle) {
    const double wrapped = std::remainder(angle, 360.0);
    return wrapped == -180.0 ? 180.0 : wrapped;
}

}  // namespace dollytrack::ui
