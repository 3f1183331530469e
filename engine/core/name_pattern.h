#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dollytrack {

/// Whether the whole text fits a pattern in which `*` stands for any characters and `?` for one.
/// Upper and lower case differ.
[[nodiscard]] bool fitsPattern(std::string_view pattern, std::string_view text);

/// The text with the letters A to Z in lower case.
[[nodiscard]] std::string inSmallLetters(std::string_view text);

/// "room" of "room.semantic.txt" and the ending ".semantic.txt"; nothing where the name ends
/// otherwise.
[[nodiscard]] std::optional<std::string> withoutEnding(std::string_view name,
                                                       std::string_view ending);

}  // namespace dollytrack
