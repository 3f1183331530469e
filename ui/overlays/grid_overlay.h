#pragma once

#include "ui/overlays/legend.h"

#include <Eigen/Geometry>

namespace dollytrack::ui {

/// Squares of a metre (of ten where a scene is as large as a town) at the height of the floor, on
/// the world's own coordinates, below `room` and a few metres beside it; every fifth line is bold.
[[nodiscard]] PlanLayer gridLayer(const Eigen::AlignedBox3d& room, double floor_z);

}  // namespace dollytrack::ui
