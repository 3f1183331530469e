#pragma once

#include "engine/core/result.h"

#include <string_view>

namespace dollytrack::cli {

/// From here on everything printed to `stdout` passes cleanLines() on its way to the descriptor,
/// whoever prints it: names in scenes, paths and values may hold what a terminal would obey.
/// JSON stays valid, as it has no control characters but line breaks. `stdout` has no descriptor
/// of its own any more. Called once, at the program's start.
void cleanStandardOutput();

/// Writes out what was printed so far. Error: CannotWrite, where any of it could not be written.
Status finishStandardOutput();

/// Cleans a message the same way and writes it to standard error, with a line break.
void printToStandardError(std::string_view message);

}  // namespace dollytrack::cli
