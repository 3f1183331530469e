#pragma once

#include "render/draw/passes/gpu_scene.h"
#include "render/gl/handle.h"
#include "render/view/view.h"

#include <functional>
#include <vector>

namespace dollytrack::render {

/// Orders a scene's glass back to front for alpha blending.
class GlassOrder {
  public:
    /// Calls draw(batch, first index, count) for the sheets of visible objects, farthest first,
    /// merging consecutive sheets of one batch. During the calls the scene's vertex array uses a
    /// sorted index buffer of its own.
    void visit(const GpuScene& scene, const View& view, const std::vector<bool>& visible,
               const std::function<void(const Batch&, std::uint32_t, std::uint32_t)>& draw);

  private:
    gl::Buffer indices_;
    std::size_t capacity_ = 0;
    std::vector<std::uint32_t> sorted_;
};

}  // namespace dollytrack::render
