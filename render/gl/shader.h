#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <span>
#include <string>
#include <string_view>

namespace dollytrack::gl {

/// Source text of a file in assets/shaders. The text is compiled into the program, so no file is
/// needed at run time. Empty if there is no such file.
[[nodiscard]] std::string_view shaderSource(std::string_view name);

/// Compiles and links two shaders, given by file names in assets/shaders. An empty `fragment` makes
/// a depth-only program. Each word in `defined` becomes a macro of the fragment shader. Returns
/// Failed with the driver's message if compiling or linking fails.
[[nodiscard]] Result<Program> linkProgram(std::string_view vertex, std::string_view fragment,
                                          std::span<const std::string> defined = {});

}  // namespace dollytrack::gl
