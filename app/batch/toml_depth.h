#pragma once

#include "engine/core/result.h"

#include <string>
#include <string_view>

namespace dollytrack::batch {

/// Refuses TOML whose keys have more parts ("a.b.c" has three), or whose brackets nest deeper, than
/// any jobs file needs: toml++ makes a table for each part and frees tables by recursion, which
/// overflows the stack. Error: BadInput, with file and line.
Status checkTomlDepth(std::string_view text, const std::string& file);

}  // namespace dollytrack::batch
