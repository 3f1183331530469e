#pragma once

#include "render/draw/gpu_scene.h"
#include "render/draw/view.h"
#include "render/gl/handle.h"

#include <functional>
#include <vector>

namespace dollytrack::render {

/// Draws a scene's glass from back to front, so that each sheet shows what is behind it.
class GlassOrder {
  public:
    /// Sheets of the objects in view, the farthest first, in runs of one batch: draw(batch, first
    /// index, count), with an index buffer of its own in the scene's layout meanwhile.
    void visit(const GpuScene& scene, const View& view, const std::vector<bool>& visible,
               const std::function<void(const Batch&, std::uint32_t, std::uint32_t)>& draw);

  private:
    gl::Buffer indices_;
    std::size_t capacity_ = 0;
    std::vector<std::uint32_t> sorted_;
};

}  // namespace dollytrack::render
