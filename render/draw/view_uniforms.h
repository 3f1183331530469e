#pragma once

#include "render/draw/gpu_scene.h"
#include "render/draw/view.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

[[nodiscard]] Eigen::Matrix3f cameraFromWorld(const View& view);

/// Sets uniforms 0..3 of surface.vert and silhouette.vert.
void setCamera(unsigned program, const View& view);

/// Sets the uniform that tells planar depths from the depth buffer, see surface.vert.
void setDepthSpan(unsigned program, int location, const View& view);
void setRotation(unsigned program, int location, const Eigen::Matrix3f& rotation);
/// Pixel position to a ray with z = 1: scale and offset of x and y. In an orthographic view: to
/// x and y themselves, m.
void setUnproject(unsigned program, int location, const View& view);

/// By id - 1: not hidden, and the box reaches into what the view shows.
[[nodiscard]] std::vector<bool> objectsInView(const GpuScene& scene, const View& view);

}  // namespace dollytrack::render
