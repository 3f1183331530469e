#pragma once

#include <span>

namespace dollytrack::ui {

/// A combo box without a label. Its entries are called "<name>.0", "<name>.1", ... in the item map.
/// Returns whether another entry was chosen.
bool choiceCombo(const char* name, int& chosen, std::span<const char* const> entries);

}  // namespace dollytrack::ui
