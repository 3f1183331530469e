#pragma once

#include <string>

namespace CLI {
class App;
}

namespace dollytrack::manual {

/// The manual page (section 1, troff) of a program or of one of its subcommands, from its help
/// texts. `more` is troff text inserted before notes and examples.
[[nodiscard]] std::string manPage(const CLI::App& program, const CLI::App& command,
                                  const std::string& version, const std::string& more = {});

/// Escapes a text for troff.
[[nodiscard]] std::string troffText(const std::string& text);

}  // namespace dollytrack::manual
