#pragma once

#include "engine/io/homes/home.h"
#include "engine/io/homes/model_library.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::homes {

/// Bounding boxes of a model, before and after the piece's `model_rotation` about the centre of
/// the first box. The second encloses the rotated vertices, because the rotated box itself would
/// have a larger bounding box.
struct ModelBounds {
    Eigen::AlignedBox3d own;
    Eigen::AlignedBox3d turned;
};
ModelBounds boundsOf(const FurnitureModel& model, const HomePiece& piece);

/// The transform of a piece's model from its own axes (y up, front +z) to the source's (x of the
/// plan, y up, z the plan's y; cm).
Eigen::Affine3d sourceFromModel(const HomePiece& piece, const ModelBounds& bounds,
                                double level_elevation);

/// The direction of a piece's front in the source's axes: the plan's +y rotated by its angle.
Eigen::Vector3d frontOf(const HomePiece& piece);

}  // namespace dollytrack::homes
