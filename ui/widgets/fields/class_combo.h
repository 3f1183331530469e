#pragma once

#include <optional>
#include <string>

namespace dollytrack::ui {

/// A combo box with the 40 NYU classes and a search field; `filter` holds the search text. `nyu40`
/// is the present class, 0 if it is unknown, unset for objects of several classes. Returns the
/// class if another one was chosen.
std::optional<int> classCombo(std::optional<int> nyu40, std::string& filter,
                              const std::string& name);

}  // namespace dollytrack::ui
