#pragma once

#include "app/manual/manual_files.h"

namespace dollytrack::cli {

/// What the manual of the command line says beside the definitions of its options.
[[nodiscard]] manual::ManualSettings manualSettings();

}  // namespace dollytrack::cli
