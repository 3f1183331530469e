#pragma once

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dollytrack::manual {

/// The values that an option takes, where its definition does not list them itself.
struct KnownValues {
    std::vector<std::string> values;  // one that ends in "=" is followed by anything
    bool comma_separated = false;
};

/// By the long name of the option, such as "--set".
using ValuesByOption = std::map<std::string, KnownValues>;

/// What an option or argument takes, for completion in a shell.
struct ValueWords {
    enum class Kind { None, Anything, File, Folder, Known };
    Kind kind = Kind::None;
    KnownValues known;
};

struct OptionWords {
    std::vector<std::string> names;  // "-o", "--out"
    std::string text;
    std::string type;  // as help calls the value
    ValueWords value;
};

/// A program, or one of its subcommands.
struct CommandWords {
    std::string name;  // empty for the program itself
    std::string text;
    std::vector<OptionWords> options;
    ValueWords argument;  // of its first positional argument
};

/// The program, then its subcommands, in the order of its help.
[[nodiscard]] std::vector<CommandWords> commandWords(const CLI::App& program,
                                                     const ValuesByOption& known);

}  // namespace dollytrack::manual
