#pragma once

#include "ui/overlays/legend.h"

#include <Eigen/Geometry>

namespace dollytrack::ui {

/// A grid at floor height `floor_z` (m), aligned to the world's axes, covering `room` and 2 m
/// around it. Squares are 1 m wide, or 10 m (100 m ...) if there would be more than 200 in a row.
/// Every fifth line is bold. The layer is empty if `room` is.
[[nodiscard]] PlanLayer gridLayer(const Eigen::AlignedBox3d& room, double floor_z);

}  // namespace dollytrack::ui
