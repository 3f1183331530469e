#pragma once

#include <string>
#include <string_view>

namespace dollytrack {

/// Whether the whole text fits a pattern in which `*` stands for any characters and `?` for one.
/// Upper and lower case differ.
[[nodiscard]] bool fitsPattern(std::string_view pattern, std::string_view text);

/// The text with the letters A to Z in lower case.
[[nodiscard]] std::string inSmallLetters(std::string_view text);

}  // namespace dollytrack
