#pragma once

#include <string>
#include <string_view>

namespace dollytrack {

/// As cleanText(), but line breaks and tabs stay: for text of several lines.
[[nodiscard]] std::string cleanLines(std::string_view text);

/// cleanLines() for text that comes in pieces, which may end within a character.
class LineCleaner {
  public:
    /// The clean text up to the last whole character.
    [[nodiscard]] std::string add(std::string_view piece);

  private:
    std::string pending_;  // the beginning of a character, at most three bytes
};

}  // namespace dollytrack
