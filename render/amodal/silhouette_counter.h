#pragma once

#include "engine/core/result.h"
#include "render/draw/gpu_scene.h"
#include "render/draw/view.h"
#include "render/frames/projected_box.h"
#include "render/gl/handle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Counts the pixels that objects would cover if each stood alone before an unbounded image. Of an
/// object that may cover many times the image, one pixel in sixteen is counted outside of it.
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

    /// Queries that make up the count of an object; -1: none.
    struct Asked {
        int pixels = -1;
        int sixteenths = -1;
        int sixteenths_inside = -1;  // where `pixels` has the image
    };

    Asked ask(const View& view, const Piece& piece, const PixelRect& rect, const PixelRect& limits);
    /// @return the query of what the part of the view, or a rectangle in it, shows of the piece
    int count(const View& part, const Piece& piece, Canvas& canvas,
              const PixelRect* rect = nullptr);
    [[nodiscard]] std::uint64_t resultOf(int query) const;

    gl::Program program_;
    Canvas small_;  // for silhouettes no larger than the image: nearly all
    Canvas large_;
    std::vector<gl::Query> queries_;  // reused
    int next_query_ = 0;
    std::vector<Asked> asked_;  // of each id
};

}  // namespace dollytrack::render
