#pragma once

#include "app/manual/command_words.h"

#include <string>
#include <vector>

namespace dollytrack::manual {

/// Shell scripts that complete subcommands, options and values. `commands` is the result of
/// commandWords().
[[nodiscard]] std::string bashCompletion(const std::string& program,
                                         const std::vector<CommandWords>& commands);
[[nodiscard]] std::string zshCompletion(const std::string& program,
                                        const std::vector<CommandWords>& commands);
[[nodiscard]] std::string fishCompletion(const std::string& program,
                                         const std::vector<CommandWords>& commands);

}  // namespace dollytrack::manual
