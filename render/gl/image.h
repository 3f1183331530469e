#pragma once

#include "render/gl/handle.h"

namespace dollytrack::gl {

/// Creates a texture with one level for passes to render into and sample. It clamps at its borders.
/// @param format  sized OpenGL format, for example GL_RGBA8
/// @param smooth  linear filtering instead of nearest
[[nodiscard]] Texture createImage(unsigned format, int width, int height, bool smooth = false);

}  // namespace dollytrack::gl
