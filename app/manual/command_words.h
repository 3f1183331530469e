#pragma once

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dollytrack::manual {

/// The values that an option accepts, if its definition does not list them.
struct KnownValues {
    std::vector<std::string> values;  // a value that ends in "=" may be followed by any text
    bool comma_separated = false;
};

/// By the option's long name, such as "--set".
using ValuesByOption = std::map<std::string, KnownValues>;

/// The kind of value that an option or argument takes, for shell completion.
struct ValueWords {
    enum class Kind { None, Anything, File, Folder, Known };
    Kind kind = Kind::None;
    KnownValues known;
};

struct OptionWords {
    std::vector<std::string> names;  // "-o", "--out"
    std::string text;
    std::string type;  // the value's name in the help
    ValueWords value;
};

/// A program or one of its subcommands.
struct CommandWords {
    std::string name;  // empty for the program itself
    std::string text;
    std::vector<OptionWords> options;
    ValueWords argument;  // of the first positional argument
};

/// The program, then its subcommands, in the order of the help.
[[nodiscard]] std::vector<CommandWords> commandWords(const CLI::App& program,
                                                     const ValuesByOption& known);

}  // namespace dollytrack::manual
