#pragma once

#include "render/gl/handle.h"

namespace dollytrack::gl {

/// A texture of one level that passes draw into and read from: clamped at its borders.
/// @param format  OpenGL's, with its size: GL_RGBA8
/// @param smooth  read between its pixels, too, and not at the nearest
[[nodiscard]] Texture createImage(unsigned format, int width, int height, bool smooth = false);

}  // namespace dollytrack::gl
