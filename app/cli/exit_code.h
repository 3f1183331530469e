#pragma once

#include "engine/core/result.h"

#include <exception>

namespace dollytrack::cli {

/// Exit codes of dollytrack and dollytrack-editor; the table is in the repository's README.md.
enum ExitCode : int {
    kDone = 0,
    kFailed = 1,
    kUsage = 2,
    kPartial = 3,
    kBadInput = 4,
    kNoOpenGl = 5,
    kCannotWrite = 6,
};

/// The exit code for an error.
int exitCodeFor(ErrorCode code);

/// Converts an otherwise uncaught exception to an error message.
Error errorOf(const std::exception& exception);

}  // namespace dollytrack::cli
