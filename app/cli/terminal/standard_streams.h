#pragma once

#include "engine/core/result.h"

#include <string_view>

namespace dollytrack::cli {

/// Redirects `stdout` through cleanLines(), because names in scenes, paths and values may contain
/// terminal control sequences. JSON stays valid, since it contains no control characters but line
/// breaks. Afterwards `stdout` has no file descriptor. To be called once, at program start.
void cleanStandardOutput();

/// Flushes standard output. Error: CannotWrite if any output so far could not be written.
Status finishStandardOutput();

/// Writes a message, cleaned in the same way, and a line break to standard error.
void printToStandardError(std::string_view message);

}  // namespace dollytrack::cli
