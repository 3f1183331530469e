#pragma once

#include "engine/core/result.h"

#include <string>
#include <string_view>

namespace dollytrack::batch {

/// Checks TOML before parsing: keys may have at most 16 parts ("a.b.c" has three), and brackets may
/// nest at most 32 deep. toml++ creates a table for each part and frees tables recursively, which
/// could overflow the stack. Error: BadInput, with file and line.
Status checkTomlDepth(std::string_view text, const std::string& file);

}  // namespace dollytrack::batch
