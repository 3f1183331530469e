#pragma once

#include "engine/io/homes/home.h"
#include "engine/io/homes/model_library.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::homes {

/// The box around a model in its own axes, and around what it is when a piece has turned it about
/// the first one's middle: exactly, since models drawn askew are turned straight.
struct ModelBounds {
    Eigen::AlignedBox3d own;
    Eigen::AlignedBox3d turned;
};
ModelBounds boundsOf(const FurnitureModel& model, const HomePiece& piece);

/// Where a piece's model goes: from the model's axes (y up, front +z) into the source's (x the
/// plan's, y up, z the plan's y; cm).
Eigen::Affine3d sourceFromModel(const HomePiece& piece, const ModelBounds& bounds,
                                double level_elevation);

/// The way a piece looks, in the source's axes: the plan's +y turned by its angle.
Eigen::Vector3d frontOf(const HomePiece& piece);

}  // namespace dollytrack::homes
