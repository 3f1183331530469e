#pragma once

#include "render/draw/passes/gpu_scene.h"
#include "render/view/view.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

[[nodiscard]] Eigen::Matrix3f cameraFromWorld(const View& view);

/// Sets uniforms 0 to 3 of surface.vert and silhouette.vert.
void setCamera(unsigned program, const View& view);

/// Sets the uniform that converts depth-buffer values to planar depth; see surface.vert.
void setDepthSpan(unsigned program, int location, const View& view);
void setRotation(unsigned program, int location, const Eigen::Matrix3f& rotation);
/// Sets the scale and offset that turn a pixel position into the x and y of a ray with z = 1, or,
/// in an orthographic view, into x and y in the camera frame, m.
void setUnproject(unsigned program, int location, const View& view);

/// Sets the uniforms of the lower and the upper corner of View::clip_box.
void setClipBox(unsigned program, int low_location, int high_location, const View& view);

/// By id - 1: the object is not hidden and its box reaches into the view.
[[nodiscard]] std::vector<bool> objectsInView(const GpuScene& scene, const View& view);

}  // namespace dollytrack::render
