#pragma once

#include <CLI/CLI.hpp>

namespace dollytrack::cli {

/// A validator that converts a unit's name to metres per unit: m, dm, cm, mm, km, inch (in), ft or
/// yd. Numbers must be 1e-6 .. 1e6.
[[nodiscard]] CLI::Validator lengthUnit();

}  // namespace dollytrack::cli
