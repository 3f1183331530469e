#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/math/pose.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dollytrack::render {

/// Leaves structure away, to look into a room from outside: what lies above the plane, where
/// dot(p, xyz) > w, and above keep_below_z.
struct StructureCut {
    Eigen::Vector4d plane = {0, 0, 0, 1};
    double keep_below_z = 0.0;
};

/// One picture to be drawn.
struct View {
    Intrinsics intrinsics;
    Pose pose;
    double near_m = 0.05;
    /// By object id; ids beyond its end are shown. Empty: everything is shown.
    std::vector<bool> hidden;
    std::optional<StructureCut> structure_cut;
    /// Colour (sRGB 0..1) where nothing is hit; none: a sky.
    std::optional<Eigen::Vector3f> backdrop;
};

}  // namespace dollytrack::render
