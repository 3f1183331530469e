#pragma once

#include "engine/core/result.h"

#include <string>

namespace dollytrack::cli {

/// Whether a file can be written there, as far as one can tell without writing it: asked before
/// long work, so that its result is not lost for a mistyped folder. Empty: nothing is to be
/// written. Error: CannotWrite.
Status checkWritable(const std::string& path);

}  // namespace dollytrack::cli
