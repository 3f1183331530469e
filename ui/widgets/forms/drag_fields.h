#pragma once

#include "engine/scene/object.h"
#include "ui/widgets/forms/number_input.h"

#include <Eigen/Core>

#include <string>

namespace dollytrack::ui {

/// Limits and looks of a number that is dragged.
struct DragRange {
    double min = -1000.0;
    double max = 1000.0;
    float speed = 0.01F;  // a pixel
    const char* format = "%.2f";
    const char* unit = "";
};

constexpr DragRange kPlaceRange = {-1e4, 1e4, 0.01F, "%.2f"};   // m
constexpr DragRange kLengthRange = {0.01, 1e4, 0.01F, "%.2f"};  // m
constexpr DragRange kAngleRange = {-360.0, 360.0, 0.5F, "%.1f", "\u00b0"};

/// A number with the width set by SetNextItemWidth().
FieldEdit dragNumber(double& value, const DragRange& range, const std::string& name,
                     const std::string& tip = {});
/// Three numbers that share the width at hand but for `spare` px; named `name`.x, .y and .z.
FieldEdit dragPoint(Eigen::Vector3d& point, const DragRange& range, const std::string& name,
                    const std::string& tip = {}, float spare = 0.0F);

/// What was edited of a box.
struct BoxEdit {
    FieldEdit center, size, yaw;
};
/// Rows of a form (widgets/form.h) for a box; named `name`.center.x and so on.
BoxEdit boxRows(OrientedBox& box, const std::string& name);

/// An angle in degrees, -180 (not included) .. 180.
double wrapDegrees(double angle);

}  // namespace dollytrack::ui
