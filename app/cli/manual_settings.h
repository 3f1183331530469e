#pragma once

#include "app/manual/manual_files.h"

namespace dollytrack::cli {

/// Content of the command line's manual that its option definitions lack.
[[nodiscard]] manual::ManualSettings manualSettings();

}  // namespace dollytrack::cli
