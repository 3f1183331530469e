#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/intrinsics.h"
#include "engine/camera/picture_params.h"
#include "engine/math/pose.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dollytrack::render {

/// Leaves structure away, to look into a room from outside: what lies above the plane, where
/// dot(p, xyz) > w, and above keep_below_z; and all above ceiling_z.
struct StructureCut {
    Eigen::Vector4d plane = {0, 0, 0, 1};
    double keep_below_z = 0.0;
    double ceiling_z = 1e9;
};

/// Parallel rays instead of a pinhole, for plans and elevations. The image's middle, the principal
/// point of the intrinsics, is what lies straight ahead; the focal length has no meaning.
struct Orthographic {
    double px_per_m = 100.0;
    double depth_m = 250.0;  // what lies further behind the near plane is cut
};

/// A ray through a pixel; lengths along it are planar depths.
struct ViewRay {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // world
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// One picture to be drawn. Depth is always measured along the viewing axis.
struct View {
    Intrinsics intrinsics;
    Pose pose;
    double near_m = 0.05;
    /// By object id; ids beyond its end are shown. Empty: everything is shown.
    std::vector<bool> hidden;
    std::optional<StructureCut> structure_cut;
    /// Colour (sRGB 0..1) where nothing is hit; none: a sky.
    std::optional<Eigen::Vector3f> backdrop;
    /// Of the colours; more looks are for exports, and for a preview at rest.
    Antialias antialias = Antialias::Edges;
    /// Where the renderer has been given what shows them, see SceneRenderer::setReflections().
    Reflections reflections = Reflections::Blurred;
    /// Finely divided things in fewer triangles, where the renderer has them; for a view that
    /// moves.
    bool coarse = false;
    /// None: a pinhole camera.
    std::optional<Orthographic> orthographic;

    /// Image position (px) of a point in the camera's frame; in a pinhole camera with z > 0.
    [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& in_camera) const;
    /// The ray through an image position.
    [[nodiscard]] ViewRay rayThrough(double x, double y) const;
};

/// Where the right camera of a stereo pair is.
[[nodiscard]] Pose rightOf(const Pose& left, double baseline_m);

/// What a camera at this pose takes a picture of.
[[nodiscard]] View makeView(const CameraParams& camera, const Pose& pose);

}  // namespace dollytrack::render
