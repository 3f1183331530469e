#pragma once

#include "engine/core/result.h"
#include "render/draw/gpu_scene.h"
#include "render/draw/view.h"
#include "render/gl/handle.h"

#include <vector>

namespace dollytrack::render {

/// Finds objects that stand wholly behind others, in rooms beyond a wall, say, so that what is
/// drawn several times need not draw them: those whose boxes pass the depth test nowhere once all
/// that is opaque has been drawn. A slit narrower than a pixel between nearer things counts as
/// closed.
class OcclusionCulling {
  public:
    [[nodiscard]] static Result<OcclusionCulling> create();

    /// Asks the depth buffer that is bound, of this view, about the large ones of these objects.
    /// Asks nothing where so few triangles are in view that drawing them costs less.
    void start(const GpuScene& scene, const View& view, const std::vector<bool>& in_view);

    /// Takes those that are hidden out of these; waits for the answers.
    void takeHidden(std::vector<bool>& in_view);

    /// How many objects the last answers hid.
    [[nodiscard]] int hidden() const { return hidden_; }

  private:
    struct Asked {
        std::size_t object;  // its id - 1
        bool hidden = false;
    };

    gl::Program box_;
    gl::VertexArray no_vertices_;
    std::vector<gl::Query> queries_;  // reused
    std::vector<Asked> asked_;
    bool answered_ = true;
    int hidden_ = 0;
};

}  // namespace dollytrack::render
