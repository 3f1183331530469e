#pragma once

#include <optional>
#include <string>

namespace dollytrack::ui {

/// A combo box with the 40 NYU classes and a search field; `filter` holds the search text. Returns
/// the class if another one was chosen.
std::optional<int> classCombo(int nyu40, std::string& filter, const std::string& name);

}  // namespace dollytrack::ui
