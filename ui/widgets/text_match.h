#pragma once

#include <string_view>

namespace dollytrack::ui {

// Text comparisons that ignore the case of ASCII letters; other characters are compared as bytes.

[[nodiscard]] bool containsIgnoringCase(std::string_view text, std::string_view part);
[[nodiscard]] bool beginsWithIgnoringCase(std::string_view text, std::string_view part);

}  // namespace dollytrack::ui
