#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/intrinsics.h"
#include "engine/camera/picture_params.h"
#include "engine/math/pose.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace dollytrack::render {

/// Cuts structure away to show a room from outside: all points p above the plane (dot(p, xyz) > w)
/// and above keep_below_z, and all points above ceiling_z. World frame, m.
struct StructureCut {
    Eigen::Vector4d plane = {0, 0, 0, 1};
    double keep_below_z = 0.0;
    double ceiling_z = 1e9;
};

/// Orthographic projection, for plans and elevations. The principal point of the intrinsics lies on
/// the viewing axis; the focal length is ignored.
struct Orthographic {
    double px_per_m = 100.0;
    double depth_m = 250.0;  // distance from the near plane to the far plane
};

/// A ray through a pixel. The direction is scaled so that lengths along it are planar depths.
struct ViewRay {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // world
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// One view to draw. Depth is measured along the viewing axis.
struct View {
    Intrinsics intrinsics;
    Pose pose;
    double near_m = 0.05;
    /// By object id; ids beyond its end are visible. Empty: all objects are visible.
    std::vector<bool> hidden;
    std::optional<StructureCut> structure_cut;
    /// Only what lies inside is drawn, m, world.
    std::optional<Eigen::AlignedBox3d> clip_box;
    /// Background colour (sRGB 0..1); none: a sky.
    std::optional<Eigen::Vector3f> backdrop;
    /// Antialiasing of the colour image. Multisampling is meant for exports and still previews.
    Antialias antialias = Antialias::Edges;
    /// Takes effect if the renderer has reflections; see SceneRenderer::setReflections().
    Reflections reflections = Reflections::Blurred;
    /// Draws simplified meshes, if the renderer has them (Detail::FullAndCoarse), and no ambient
    /// occlusion; for a moving view and for the first image of a scene. Without antialiasing only.
    bool coarse = false;
    /// None: a pinhole camera.
    std::optional<Orthographic> orthographic;

    /// Image position (px) of a point in the camera frame; a pinhole camera needs z > 0.
    [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& in_camera) const;
    /// The ray through an image position, px.
    [[nodiscard]] ViewRay rayThrough(double x, double y) const;
};

/// Pose of the right camera of a stereo pair.
[[nodiscard]] Pose rightOf(const Pose& left, double baseline_m);

/// The view of a camera at this pose: its intrinsics and near plane.
[[nodiscard]] View makeView(const CameraParams& camera, const Pose& pose);

}  // namespace dollytrack::render
