#pragma once

#include <string>

namespace dollytrack::ui {

/// A line of text that counts when it is whole: with Enter, or when another widget is clicked;
/// Escape takes it back. Returns whether it was entered and is another than before. As wide as
/// SetNextItemWidth() says.
bool textField(std::string& text, const std::string& name);

}  // namespace dollytrack::ui
