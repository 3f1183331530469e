#pragma once

#include <string>

namespace dollytrack::ui {

/// A text field that commits with Enter or on losing focus; Escape reverts. Returns whether the
/// text was committed and changed. Its width is set by SetNextItemWidth().
bool textField(std::string& text, const std::string& name);

}  // namespace dollytrack::ui
