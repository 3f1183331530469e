#pragma once

#include <string_view>

namespace dollytrack::ui {

// Comparisons of what people type: a to z are the same as A to Z, other characters count as bytes.

[[nodiscard]] bool containsIgnoringCase(std::string_view text, std::string_view part);
[[nodiscard]] bool beginsWithIgnoringCase(std::string_view text, std::string_view part);

}  // namespace dollytrack::ui
