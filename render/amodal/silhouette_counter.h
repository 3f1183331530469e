#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/gpu_scene.h"
#include "render/gl/handle.h"
#include "render/view/projected_box.h"
#include "render/view/view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Counts the pixels that each object would cover if it stood alone in front of a much larger
/// image. For objects that may cover more than four times the image, only one pixel in sixteen is
/// counted outside the image.
class SilhouetteCounter {
  public:
    SilhouetteCounter() = default;
    [[nodiscard]] static Result<SilhouetteCounter> create();

    /// See SceneRenderer::startSilhouettes().
    [[nodiscard]] Status start(const GpuScene& scene, const View& view,
                               std::span<const int> object_ids, int beyond);
    [[nodiscard]] std::vector<std::uint64_t> finish();

  private:
    /// A depth buffer that remembers which pixels the current object has already covered.
    struct Canvas {
        int width = 0;
        int height = 0;
        gl::Texture depth;
        gl::Framebuffer frame;
        std::uint32_t used = 0;  // depth levels used since the last clear

        void resize(int new_width, int new_height);
        void begin();
        /// Returns a depth nearer than all earlier ones; clears the buffer when the levels run out.
        double nextLevel();
    };

    /// Occlusion queries that make up an object's count; -1: none.
    struct PixelQueries {
        int pixels = -1;
        int sixteenths = -1;
        int sixteenths_inside = -1;  // the part of `sixteenths` that `pixels` counts already
    };

    PixelQueries startQueries(const View& view, const Piece& piece, const PixelRect& rect,
                              const PixelRect& limits);
    /// Draws a piece in a part of the view, or in a rectangle of it. @return index of the query
    /// that counts its pixels
    int count(const View& part, const Piece& piece, Canvas& canvas,
              const PixelRect* rect = nullptr);
    [[nodiscard]] std::uint64_t resultOf(int query) const;

    gl::Program program_;
    Canvas small_;  // for silhouettes no larger than the image: nearly all
    Canvas large_;
    std::vector<gl::Query> queries_;  // reused
    int next_query_ = 0;
    std::vector<PixelQueries> pixel_queries_;  // in the order of the ids
};

}  // namespace dollytrack::render
