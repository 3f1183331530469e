#pragma once

#include <span>

namespace dollytrack::ui {

/// A combo box without a label; its entries are named "<name>.0", "<name>.1", ... for scripts.
/// Returns whether another one was chosen.
bool choiceCombo(const char* name, int& chosen, std::span<const char* const> entries);

}  // namespace dollytrack::ui
