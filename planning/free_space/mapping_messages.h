#pragma once

#include "engine/core/result.h"

#include <string>

namespace dollytrack::planning {

/// The error of a cancelled mapping job.
[[nodiscard]] tl::unexpected<Error> mappingCancelled();

/// A length with unit and three significant digits: "0.05 m".
[[nodiscard]] std::string inMetres(double value);

}  // namespace dollytrack::planning
