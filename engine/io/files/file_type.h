#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dollytrack {

/// A text without the byte-order mark that some editors put at its beginning.
[[nodiscard]] std::string_view withoutByteOrderMark(std::string_view text);

/// A text without leading blanks and byte-order mark.
std::string_view fromFirstLetter(std::string_view head);

/// The first character of a text after blanks and a byte-order mark; 0 if there is none.
char firstLetter(std::string_view head);

/// The extension in lower case: ".gltf" for "room.GLTF".
std::string lowerExtension(const std::filesystem::path& path);

}  // namespace dollytrack
