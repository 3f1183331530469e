#include "app/manual/completions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>

namespace dollytrack::manual {
namespace {

using Kind = ValueWords::Kind;

/// A name that is valid as a shell function: '-' is replaced.
std::string identifier(std::string name) {
    for (char& c : name) {
        if (c == '-') c = '_';
    }
    return name;
}

/// The text in single quotes, with inner quotes replaced by `quote`.
std::string quoted(std::string_view text, std::string_view quote) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'') {
            result += quote;
        } else {
            result += c;
        }
    }
    return result + "'";
}

std::string quotedForShell(std::string_view text) { return quoted(text, "'\\''"); }

/// The beginning of a text, shortened for a list of completions.
std::string shortText(const std::string& text) {
    constexpr std::size_t kMost = 100;
    std::string first = text.substr(0, std::min(text.find('\n'), text.find("; ")));
    if (first.size() <= kMost) return first;
    first.resize(first.rfind(' ', kMost));
    return first + " ...";
}

/// Assignments that tell the bash function below how to complete a value.
std::string bashKind(const ValueWords& value) {
    switch (value.kind) {
        case Kind::None:
            return {};
        case Kind::Anything:
            return "kind=anything";
        case Kind::File:
            return "kind=file";
        case Kind::Folder:
            return "kind=folder";
        case Kind::Known:
            break;
    }
    return fmt::format("kind={} words={}", value.known.comma_separated ? "list" : "words",
                       quotedForShell(fmt::format("{}", fmt::join(value.known.values, " "))));
}

/// Branches of a case statement; patterns with equal actions are combined.
std::string bashBranches(const std::vector<std::pair<std::string, std::string>>& action_by_pattern) {
    std::vector<std::string> actions;
    std::map<std::string, std::vector<std::string>> patterns;
    for (const auto& [pattern, action] : action_by_pattern) {
        if (action.empty()) continue;
        auto& of_action = patterns[action];
        if (of_action.empty()) actions.push_back(action);
        of_action.push_back(pattern);
    }
    std::string text;
    for (const std::string& action : actions) {
        text += fmt::format("        {}) {} ;;\n", fmt::join(patterns[action], " | "), action);
    }
    return text;
}

constexpr std::string_view kBashEnd = R"(    esac
    [[ $kind || $current != -* ]] || kind=words words=$options
    [[ $kind ]] || kind=$argument

    local list=()
    case $kind in
        words) mapfile -t list < <(compgen -W "$words" -- "$current") ;;
        list) mapfile -t list < <(compgen -W "$words" -P "${current%"${current##*,}"}" \
            -- "${current##*,}") ;;
        file) mapfile -t list < <(compgen -f -- "$current") ;;
        folder) mapfile -t list < <(compgen -d -- "$current") ;;
    esac
    case $kind in
        file | folder) compopt -o filenames 2>/dev/null ;;
        list) compopt -o nospace 2>/dev/null ;;
        words) [[ ${list[0]-} != *= ]] || compopt -o nospace 2>/dev/null ;;
    esac
    # Only what follows the last "=" is replaced.
    if [[ $COMP_WORDBREAKS == *=* && $current == *=* ]]; then
        list=("${list[@]#"${current%"${current##*=}"}"}")
    fi
    COMPREPLY=("${list[@]}")
}
)";

/// Escapes a description for _arguments of zsh, where brackets and colons are special.
std::string zshText(const std::string& text) {
    std::string result;
    for (const char c : shortText(text)) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

/// Generates zsh functions, one for each distinct list of values.
class ZshFunctions {
  public:
    explicit ZshFunctions(std::string prefix) : prefix_(std::move(prefix)) {}

    /// The value part of an _arguments specification, ":name:action"; empty for options without a
    /// value.
    std::string completed(const std::string& type, const ValueWords& value) {
        const std::string what = ":" + zshText(type.empty() ? "value" : type) + ":";
        switch (value.kind) {
            case Kind::None:
                return {};
            case Kind::Anything:
                return what + " ";
            case Kind::File:
                return what + "_files";
            case Kind::Folder:
                return what + "_files -/";
            case Kind::Known:
                break;
        }
        return what + function(value.known);
    }

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string function(const KnownValues& known) {
        std::string body;
        if (known.comma_separated) {
            body = fmt::format("    _values -s , name {}\n", fmt::join(known.values, " "));
        } else {
            std::string open;
            std::string closed;
            for (const std::string& value : known.values) {
                (value.ends_with('=') ? open : closed) += " " + value;
            }
            if (!open.empty()) body += "    compadd -S '' --" + open + "\n";
            if (!closed.empty()) body += "    compadd --" + closed + "\n";
        }
        auto& name = names_[body];
        if (name.empty()) {
            name = fmt::format("{}_values_{}", prefix_, names_.size());
            text_ += fmt::format("{}() {{\n{}}}\n\n", name, body);
        }
        return name;
    }

    std::string prefix_;
    std::string text_;
    std::map<std::string, std::string> names_;  // function names by function body
};

std::string zshOptions(const CommandWords& command, ZshFunctions& functions) {
    std::string text;
    for (const OptionWords& option : command.options) {
        const std::string value = functions.completed(option.type, option.value);
        for (const std::string& name : option.names) {
            // "+": the value may follow directly or as the next word; "=": likewise, after a "=".
            const char* join = value.empty() ? "" : name.starts_with("--") ? "=" : "+";
            text += " \\\n        " + quotedForShell(fmt::format("*{}{}[{}]{}", name, join,
                                                                 zshText(option.text), value));
        }
    }
    return text;
}

std::string fishValue(const ValueWords& value) {
    switch (value.kind) {
        case Kind::None:
            return {};
        case Kind::Anything:
            return " -x";
        case Kind::File:
            return " -r -F";
        case Kind::Folder:
            return " -x -a '(__fish_complete_directories)'";
        case Kind::Known:
            break;
    }
    const std::string values = fmt::format("{}", fmt::join(value.known.values, " "));
    return value.known.comma_separated ? fmt::format(" -x -a '(__fish_append , {})'", values)
                                       : fmt::format(" -x -a '{}'", values);
}

std::string quotedForFish(const std::string& text) {
    std::string escaped;
    for (const char c : shortText(text)) {
        if (c == '\\') escaped += '\\';
        escaped += c;
    }
    return quoted(escaped, "\\'");
}

}  // namespace

std::string bashCompletion(const std::string& program, const std::vector<CommandWords>& commands) {
    std::vector<std::pair<std::string, std::string>> of_commands;
    std::vector<std::pair<std::string, std::string>> of_options;
    std::string general;  // options accepted by every subcommand
    std::string names;
    for (const CommandWords& command : commands) {
        std::string options;
        for (const OptionWords& option : command.options) {
            for (const std::string& name : option.names) {
                options += (options.empty() ? "" : " ") + name;
                const std::string of = command.name.empty() ? "*" : command.name;
                of_options.emplace_back(of + "\\ " + name, bashKind(option.value));
            }
        }
        if (command.name.empty()) {
            general = options;
            continue;
        }
        names += (names.empty() ? "" : " ") + command.name;
        const std::string argument = bashKind(command.argument);
        of_commands.emplace_back(
            command.name, fmt::format("options+=' {}'{}", options,
                                      argument.empty() ? "" : " argument=" + argument.substr(5)));
    }
    // Subcommands' options first, because the general patterns match every subcommand.
    std::stable_partition(of_options.begin(), of_options.end(),
                          [](const auto& one) { return !one.first.starts_with('*'); });
    const std::string argument = bashKind(commands.front().argument);
    std::string text = fmt::format(
        R"(# Completion of {0} for bash, made from the definitions of its options.
_{1}() {{
    # Readline parts words at "=", as in "--set fill=0.5"; here they are whole again.
    local line=() i
    for ((i = 1; i <= COMP_CWORD; ++i)); do
        if ((${{#line[@]}})) && [[ ${{COMP_WORDS[i]}} == = || ${{COMP_WORDS[i - 1]}} == = ]]; then
            line[-1]+=${{COMP_WORDS[i]}}
        else
            line+=("${{COMP_WORDS[i]}}")
        fi
    done
    local current=${{line[-1]}} option="" command="" word
    if [[ $current == --*=* ]]; then
        option=${{current%%=*}} current=${{current#*=}}
    elif ((${{#line[@]}} > 1)); then
        option=${{line[-2]}}
    fi
    local names='{2}' options='{3}' kind="" words="" argument={4}
    for word in "${{line[@]::${{#line[@]}}-1}}"; do
        [[ $word && " $names " == *" $word "* ]] && command=$word && break
    done
)",
        program, identifier(program), names, general,
        argument.empty() ? "\"\"" : argument.substr(5));
    if (!names.empty()) {
        text += "    [[ $command ]] || argument=words words=$names\n    case $command in\n" +
                bashBranches(of_commands) + "    esac\n";
    }
    text += "    case $command\\ $option in\n" + bashBranches(of_options);
    text += kBashEnd;
    return text + fmt::format("complete -F _{} {}\n", identifier(program), program);
}

std::string zshCompletion(const std::string& program, const std::vector<CommandWords>& commands) {
    const std::string function = "_" + identifier(program);
    ZshFunctions functions(function);
    std::string list;
    std::string of_commands;
    for (const CommandWords& command : commands) {
        if (command.name.empty()) continue;
        list += "\n                " +
                quotedForShell(command.name + ":" + zshText(command.text));
        const std::string argument = functions.completed("", command.argument);
        of_commands += fmt::format("{}_{}() {{\n    _arguments -s :{}{}\n}}\n\n", function,
                                   identifier(command.name),
                                   zshOptions(commands.front(), functions) +
                                       zshOptions(command, functions),
                                   argument.empty() ? "" : " \\\n        '*" + argument + "'");
    }
    const std::string options = zshOptions(commands.front(), functions);
    std::string text = fmt::format(
        "#compdef {}\n# Completion of {} for zsh, made from the definitions of its options.\n\n",
        program, program);
    if (list.empty()) {
        const std::string argument = functions.completed("", commands.front().argument);
        text += functions.text() + of_commands;
        return text + fmt::format("_arguments -s :{}{}\n", options,
                                  argument.empty() ? "" : " \\\n        '*" + argument + "'");
    }
    text += functions.text() + of_commands;
    return text + fmt::format(R"({0}() {{
    local curcontext=$curcontext state line
    _arguments -C -s :{1} \
        '1: :->command' '*:: :->rest'
    case $state in
        command)
            local -a commands=({2})
            _describe subcommand commands ;;
        rest) (( $+functions[{0}_$words[1]] )) && {0}_$words[1] ;;
    esac
}}

{0} "$@"
)",
                              function, options, list);
}

std::string fishCompletion(const std::string& program, const std::vector<CommandWords>& commands) {
    std::string text =
        fmt::format("# Completion of {} for fish, made from the definitions of its options.\n",
                    program);
    text += fmt::format("complete -c {} -f\n", program);
    for (const CommandWords& command : commands) {
        std::string begin = "complete -c " + program;
        if (!command.name.empty()) {
            text += fmt::format("{} -n __fish_use_subcommand -a {} -d {}\n", begin, command.name,
                                quotedForFish(command.text));
            begin += fmt::format(" -n '__fish_seen_subcommand_from {}'", command.name);
        }
        if (const std::string value = fishValue(command.argument);
            command.argument.kind == Kind::File) {
            text += begin + " -F\n";
        } else if (command.argument.kind == Kind::Folder) {
            text += begin + value.substr(3) + "\n";
        }
        for (const OptionWords& option : command.options) {
            std::string names;
            for (const std::string& name : option.names) {
                names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            }
            text += begin + names + fishValue(option.value) + " -d " + quotedForFish(option.text) +
                    "\n";
        }
    }
    return text;
}

}  // namespace dollytrack::manual
