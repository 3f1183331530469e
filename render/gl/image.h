#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <string>

namespace dollytrack::gl {

/// Creates a texture with one level for passes to render into and sample. It clamps at its borders.
/// @param format  sized OpenGL format, for example GL_RGBA8
/// @param smooth  linear filtering instead of nearest
[[nodiscard]] Texture createImage(unsigned format, int width, int height, bool smooth = false);

/// Whether the driver can draw an image of this size. Error: Usage, which names `what` is drawn.
[[nodiscard]] Status checkImageSize(const std::string& what, int width, int height);

}  // namespace dollytrack::gl
