#pragma once

#include "engine/io/homes/home.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::homes {

/// Where a piece's model goes: from the model's axes (y up, front +z) into the source's (x the
/// plan's, y up, z the plan's y; cm). `corners` are the model's points or those of its box.
Eigen::Affine3d sourceFromModel(const HomePiece& piece, const Eigen::AlignedBox3d& bounds,
                                double level_elevation);

/// The way a piece looks, in the source's axes: the plan's +y turned by its angle.
Eigen::Vector3d frontOf(const HomePiece& piece);

}  // namespace dollytrack::homes
