#pragma once

#include <optional>
#include <string>

namespace dollytrack::ui {

/// The 40 NYU classes to choose from, with a line to search them. `filter` is what was typed.
/// Returns the class when another one was chosen.
std::optional<int> classCombo(int nyu40, std::string& filter, const std::string& name);

}  // namespace dollytrack::ui
