#pragma once

#include <string>

namespace CLI {
class App;
}

namespace dollytrack::manual {

/// The manual page (section 1, troff) of a program or one of its subcommands, from the texts of
/// its help. `more` is troff that comes before the examples.
[[nodiscard]] std::string manPage(const CLI::App& program, const CLI::App& command,
                                  const std::string& version, const std::string& more = {});

/// A text as troff shows it unchanged.
[[nodiscard]] std::string troffText(const std::string& text);

}  // namespace dollytrack::manual
