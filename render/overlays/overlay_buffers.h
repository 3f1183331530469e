#pragma once

#include "render/gl/handle.h"
#include "render/overlays/overlay.h"

namespace dollytrack::render {

/// An overlay in graphics memory: filled when it changes, drawn many times. Needs the OpenGL
/// context current that it was made in.
class OverlayBuffers {
  public:
    OverlayBuffers();

    /// Faces that two blocks share are left away: nobody can see them.
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
    int line_count_ = 0;
    int mark_count_ = 0;
};

}  // namespace dollytrack::render
