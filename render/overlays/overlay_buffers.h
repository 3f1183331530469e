#pragma once

#include "render/gl/handle.h"
#include "render/overlays/overlay.h"

namespace dollytrack::render {

/// An overlay in graphics memory: uploaded when it changes, drawn many times. The OpenGL context in
/// which it was created must be current for every call.
class OverlayBuffers {
  public:
    OverlayBuffers();

    /// Replaces the overlay. Faces shared by two boxes are dropped; see visibleFaces().
    void upload(const Overlay& overlay);

    [[nodiscard]] bool empty() const {
        return box_indices_ + triangle_indices_ + line_count_ + mark_count_ == 0;
    }

  private:
    friend class OverlayRenderer;

    struct Part {
        gl::Buffer vertices;
        gl::Buffer indices;
        gl::VertexArray layout;
    };
    Part surfaces_;  // boxes, then triangles
    Part strokes_;   // lines
    Part marks_;
    int box_indices_ = 0;
    int triangle_indices_ = 0;
    bool one_sided_triangles_ = false;
    int line_count_ = 0;
    int mark_count_ = 0;
};

}  // namespace dollytrack::render
