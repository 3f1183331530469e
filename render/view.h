#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/math/pose.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dollytrack::render {

/// One picture to be drawn.
struct View {
    Intrinsics intrinsics;
    Pose pose;
    double near_m = 0.05;
    /// By object id; ids beyond its end are shown. Empty: everything is shown.
    std::vector<bool> hidden;
    /// Structure where dot(p, xyz) > w is left away, to look into a room from outside.
    std::optional<Eigen::Vector4d> structure_cut;
    /// Colour (sRGB 0..1) where nothing is hit; none: a sky.
    std::optional<Eigen::Vector3f> backdrop;
};

}  // namespace dollytrack::render
