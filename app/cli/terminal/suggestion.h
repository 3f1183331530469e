#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace dollytrack::cli {

/// Explains an unknown name on a command line that failed to parse: "There is no subcommand 'paln';
/// did you mean 'plan'?", or the same for an option. Empty if all names are known.
std::string explainUnknownName(const CLI::App& app, const std::vector<std::string>& arguments);

/// One sentence for other parsing errors, such as text instead of a number, or an extra argument;
/// the parser's own message for the rest.
std::string explainRefusal(const CLI::App& app, const CLI::ParseError& error);

}  // namespace dollytrack::cli
