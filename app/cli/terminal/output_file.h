#pragma once

#include "engine/core/result.h"

#include <string>

namespace dollytrack::cli {

/// Checks, without writing, that a file can be written, so that long work does not end with a
/// failed write. An empty path is accepted. Error: CannotWrite.
Status checkWritable(const std::string& path);

}  // namespace dollytrack::cli
