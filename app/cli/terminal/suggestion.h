#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace dollytrack::cli {

/// What may be wrong with a command line that could not be parsed: "There is no subcommand 'paln';
/// did you mean 'plan'?", or the same for an option. Empty when all its names are known.
std::string explainUnknownName(const CLI::App& app, const std::vector<std::string>& arguments);

/// One sentence for what else the parser refuses: a text where a number is wanted, or an argument
/// too many. The parser's own words where there is nothing better to say.
std::string explainRefusal(const CLI::App& app, const CLI::ParseError& error);

}  // namespace dollytrack::cli
