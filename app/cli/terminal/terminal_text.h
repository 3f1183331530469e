#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dollytrack::cli {

/// Columns of the terminal behind standard output; 0 when it is none, as for a file or a pipe.
std::size_t terminalWidth();

/// The text in exactly `width` columns, UTF-8 characters counted as one each: filled up with
/// blanks, or cut with an ellipsis.
std::string inColumn(std::string_view text, std::size_t width);

/// The text in lines of at most `width` columns (0: one line), each begun with `indent` blanks and
/// ended. `lead` stands in front of the first line instead of its blanks.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent,
                    std::string_view lead = {});

}  // namespace dollytrack::cli
