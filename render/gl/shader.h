#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <span>
#include <string>
#include <string_view>

namespace dollytrack::gl {

/// Text of a file of assets/shaders, held in the program itself so that it runs from anywhere.
/// Empty when there is none of that name.
[[nodiscard]] std::string_view shaderSource(std::string_view name);

/// Compiles and links "<vertex>" with "<fragment>" (file names in assets/shaders; an empty fragment
/// makes a program that draws no colour). Each word in `defined` is a macro that the fragment
/// shader's preprocessor knows. Failed with the compiler's words.
[[nodiscard]] Result<Program> linkProgram(std::string_view vertex, std::string_view fragment,
                                          std::span<const std::string> defined = {});

}  // namespace dollytrack::gl
