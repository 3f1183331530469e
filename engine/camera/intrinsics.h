#pragma once

#include "engine/camera/camera_params.h"

#include <Eigen/Core>

namespace dollytrack {

/// A pinhole camera with square pixels. Pixel (0, 0) covers [0, 1) x [0, 1), its centre is at
/// (0.5, 0.5), and the principal point is the image's middle.
struct Intrinsics {
    int width = 0;
    int height = 0;
    double fx = 0.0;  // px
    double fy = 0.0;
    double cx = 0.0;
    double cy = 0.0;

    /// Image position (px) of a point in the camera's frame with z > 0.
    [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& in_camera) const {
        return {fx * in_camera.x() / in_camera.z() + cx, fy * in_camera.y() / in_camera.z() + cy};
    }
    /// Direction in the camera's frame through an image position; z is 1, so lengths along it are
    /// planar depths.
    [[nodiscard]] Eigen::Vector3d unproject(double x, double y) const {
        return {(x - cx) / fx, (y - cy) / fy, 1.0};
    }
};

Intrinsics makeIntrinsics(const CameraParams& params);

}  // namespace dollytrack
