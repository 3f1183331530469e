#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dollytrack::cli {

/// What may be wrong with a command line that could not be parsed: "There is no subcommand 'paln';
/// did you mean 'plan'?", or the same for an option. Empty when all its names are known.
std::string explainUnknownName(const CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace dollytrack::cli
