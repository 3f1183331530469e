#pragma once

#include "render/verify/compare/check.h"

#include <span>

namespace dollytrack::verify {

/// A row of the table of checks.
struct Check {
    const char* name;
    const char* text;                     // property that a valid dataset has, for users
    std::span<const char* const> needs;   // required modalities and formats
    std::span<const char* const> one_of;  // at least one of these is required, if any are listed
    bool needs_scene;
    /// Reads the required files that are not images and returns the check's functions. `subject`
    /// outlives them.
    CheckWork (*begin)(const Subject& subject, Findings& findings);
    /// Returns a sentence if a library that the check needs is not installed, else null.
    const char* (*missing)() = nullptr;
};

std::span<const Check> checks();

}  // namespace dollytrack::verify
