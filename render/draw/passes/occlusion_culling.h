#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/gpu_scene.h"
#include "render/gl/handle.h"
#include "render/view/view.h"

#include <vector>

namespace dollytrack::render {

/// Finds objects that stand wholly behind others, for example in other rooms, so that multisampled
/// passes can skip them. Large objects are tested with occlusion queries: an object is hidden if
/// its bounding box passes the depth test nowhere after all opaque surfaces are drawn. A gap
/// narrower than a pixel counts as closed.
class OcclusionCulling {
  public:
    [[nodiscard]] static Result<OcclusionCulling> create();

    /// Starts occlusion queries for the large objects among `in_view` against the bound depth
    /// buffer, which must belong to this view. Starts none if so few triangles are in view that
    /// drawing them costs less than the queries.
    void start(const GpuScene& scene, const View& view, const std::vector<bool>& in_view);

    /// Clears the entries of hidden objects. Waits for the queries.
    void takeHidden(std::vector<bool>& in_view);

    /// Number of objects that the last queries found hidden.
    [[nodiscard]] int hidden() const { return hidden_; }

  private:
    struct OcclusionTest {
        std::size_t object;  // id - 1
        bool hidden = false;
    };

    gl::Program box_;
    gl::VertexArray no_vertices_;
    std::vector<gl::Query> queries_;  // reused
    std::vector<OcclusionTest> occlusion_tests_;
    bool answered_ = true;
    int hidden_ = 0;
};

}  // namespace dollytrack::render
