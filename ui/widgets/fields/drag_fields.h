#pragma once

#include "engine/scene/object.h"
#include "ui/widgets/fields/number_input.h"

#include <Eigen/Core>

#include <string>

namespace dollytrack::ui {

/// Limits and format of a draggable number.
struct DragRange {
    double min = -1000.0;
    double max = 1000.0;
    float speed = 0.01F;  // change per pixel
    const char* format = "%.2f";
    const char* unit = "";
};

constexpr DragRange kPlaceRange = {-1e4, 1e4, 0.01F, "%.2f"};   // m
constexpr DragRange kLengthRange = {0.01, 1e4, 0.01F, "%.2f"};  // m
constexpr DragRange kAngleRange = {-360.0, 360.0, 0.5F, "%.1f", "\u00b0"};

/// A draggable number of the width set by SetNextItemWidth().
FieldEdit dragNumber(double& value, const DragRange& range, const std::string& name,
                     const std::string& tip = {});
/// Three numbers that share the available width except `spare` px; called `name`.x, .y and .z in
/// the item map.
FieldEdit dragPoint(Eigen::Vector3d& point, const DragRange& range, const std::string& name,
                    const std::string& tip = {}, float spare = 0.0F);

/// Edits of a box, by property.
struct BoxEdit {
    FieldEdit center, size, yaw;
};
/// Form rows (widgets/form.h) for a box; called `name`.center.x and so on in the item map.
BoxEdit boxRows(OrientedBox& box, const std::string& name);

/// Wraps an angle in degrees to -180 (excluded) .. 180.
double wrapDegrees(double angle);

}  // namespace dollytrack::ui
