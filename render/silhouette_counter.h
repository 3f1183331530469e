#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"
#include "render/gpu_scene.h"
#include "render/view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Counts the pixels that objects would cover if each stood alone before an unbounded image.
class SilhouetteCounter {
  public:
    SilhouetteCounter() = default;
    [[nodiscard]] static Result<SilhouetteCounter> create();

    /// See SceneRenderer::startSilhouettes.
    [[nodiscard]] Status start(const GpuScene& scene, const View& view,
                               std::span<const int> object_ids, int beyond);
    [[nodiscard]] std::vector<std::uint64_t> finish();

  private:
    /// A depth image that remembers which pixels the current object has already covered.
    struct Canvas {
        int width = 0;
        int height = 0;
        gl::Texture depth;
        gl::Framebuffer frame;
        std::uint32_t used = 0;  // levels of depth used since it was cleared

        void resize(int new_width, int new_height);
        void begin();
        /// A depth nearer than all before.
        double nextLevel();
    };

    gl::Program program_;
    Canvas small_;  // for silhouettes no larger than the image: nearly all
    Canvas large_;
    std::vector<gl::Query> queries_;  // reused
    std::vector<int> asked_;          // query of each id, -1: nothing to draw
};

}  // namespace dollytrack::render
