#pragma once

#include <CLI/CLI.hpp>

namespace dollytrack::cli {

/// Lets an option of metres per unit be given as a unit's name as well: m, dm, cm, mm, km, inch
/// (in), ft or yd. Numbers must be 1e-6 .. 1e6.
[[nodiscard]] CLI::Validator lengthUnit();

}  // namespace dollytrack::cli
