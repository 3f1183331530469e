#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dollytrack::cli {

/// Width of the terminal at standard output, in columns; 0 for a file or pipe.
std::size_t terminalWidth();

/// The text padded with spaces, or cut with an ellipsis, to exactly `width` columns; each UTF-8
/// character counts as one.
std::string inColumn(std::string_view text, std::size_t width);

/// The text wrapped to lines of at most `width` columns (0: one line), each indented by `indent`
/// spaces and ended by a line break. `lead` replaces the indentation of the first line.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent,
                    std::string_view lead = {});

}  // namespace dollytrack::cli
