#pragma once

#include "engine/core/result.h"

#include <string>

namespace dollytrack::planning {

/// What a mapping that was cancelled ends with.
[[nodiscard]] tl::unexpected<Error> mappingCancelled();

/// "0.05 m", three digits.
[[nodiscard]] std::string inMetres(double value);

}  // namespace dollytrack::planning
