#include "app/manual/man_page.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <sstream>
#include <vector>

namespace dollytrack::manual {
namespace {

/// The formatter as CLI::Formatter, whose functions are public and do not indent for terminals.
const CLI::Formatter& formatterOf(const CLI::App& app) {
    static const CLI::Formatter usual;
    const auto* own = dynamic_cast<const CLI::Formatter*>(app.get_formatter().get());
    return own != nullptr ? *own : usual;
}

std::string firstSentence(const std::string& text) {
    std::string line = text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    if (line.ends_with('.')) line.pop_back();
    return line;
}

std::string optionEntry(const CLI::Formatter& formatter, const CLI::Option& option) {
    const bool positional = !option.nonpositional();
    return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n",
                       troffText(formatter.make_option_name(&option, positional)),
                       troffText(formatter.make_option_opts(&option)),
                       troffText(formatter.make_option_desc(&option)));
}

/// A section of options or arguments.
std::string entries(const CLI::App& app, const std::string& heading, bool positional) {
    std::string text;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_group().empty() || option->get_positional() != positional) continue;
        text += optionEntry(formatterOf(app), *option);
    }
    return text.empty() ? text : ".SH " + heading + "\n" + text;
}

/// The help's footer, split into notes and example commands.
struct Footer {
    std::string notes;
    std::string examples;
};

Footer footerOf(const CLI::App& app) {
    constexpr std::string_view kExample = "Example: ";
    Footer footer;
    std::istringstream lines(app.get_footer());
    for (std::string line; std::getline(lines, line);) {
        if (line == "Examples:") continue;
        if (line.empty()) {
            footer.notes += footer.notes.empty() ? "" : ".PP\n";
        } else if (line.starts_with(kExample)) {
            footer.examples += ".PP\n.EX\n" + troffText(line.substr(kExample.size())) + "\n.EE\n";
        } else if (line.starts_with("  ")) {
            footer.examples += ".PP\n.EX\n" + troffText(line.substr(2)) + "\n.EE\n";
        } else if (line.starts_with("Example")) {
            footer.examples += ".PP\n" + troffText(line) + "\n";
        } else {
            footer.notes += troffText(line) + "\n";
        }
    }
    return footer;
}

}  // namespace

std::string troffText(const std::string& text) {
    std::string result;
    char before = '\n';
    for (const char c : text) {
        if (before == '\n' && (c == '.' || c == '\'')) result += "\\&";
        // Allows a line break after a comma.
        if (before == ',' && c != ' ' && c != '\n') result += "\\:";
        before = c;
        switch (c) {
            case '\\':
                result += "\\e";
                break;
            case '-':
                result += "\\-";
                break;
            case '\'':
                result += "\\(aq";
                break;
            case '^':
                result += "\\(ha";
                break;
            case '~':
                result += "\\(ti";
                break;
            case '`':
                result += "\\(ga";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string manPage(const CLI::App& program, const CLI::App& command, const std::string& version,
                    const std::string& more) {
    const bool is_program = &program == &command;
    const std::string words =
        is_program ? program.get_name() : program.get_name() + " " + command.get_name();
    std::string name = words;
    std::replace(name.begin(), name.end(), ' ', '-');
    std::string title = name;
    std::transform(title.begin(), title.end(), title.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const auto subcommands = command.get_subcommands([](const CLI::App*) { return true; });

    std::string text =
        fmt::format(".TH {} 1 \"\" \"{} {}\" \"Dollytrack\"\n.ad l\n", troffText(title),
                    program.get_name(), version.substr(0, version.find(' ')));
    text += fmt::format(".SH NAME\n{} \\- {}\n", troffText(name),
                        troffText(firstSentence(command.get_description())));
    text += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR [\\fIOPTIONS\\fR]", troffText(words));
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_positional()) continue;
        text += " \\fI" + troffText(formatterOf(command).make_option_usage(option)) + "\\fR";
    }
    text += subcommands.empty() ? "\n" : " \\fISUBCOMMAND\\fR ...\n";
    text += entries(command, "ARGUMENTS", true);
    text += entries(command, "OPTIONS", false);
    if (!is_program) {
        text += fmt::format(".PP\nThe options of \\fB{}\\fR(1) can be used, too.\n",
                            troffText(program.get_name()));
    }
    if (!subcommands.empty()) text += ".SH SUBCOMMANDS\nEach has a manual page of its own.\n";
    for (const CLI::App* one : subcommands) {
        text += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n",
                            troffText(program.get_name() + "-" + one->get_name()),
                            troffText(one->get_description()));
    }
    text += more;
    // A subcommand without a footer of its own inherits the program's.
    if (is_program || command.get_footer() != program.get_footer()) {
        const Footer footer = footerOf(command);
        if (!footer.notes.empty()) text += ".SH NOTES\n" + footer.notes;
        if (!footer.examples.empty()) text += ".SH EXAMPLES\n" + footer.examples;
    }
    if (!is_program) {
        text += fmt::format(".SH SEE ALSO\n\\fB{}\\fR(1)\n", troffText(program.get_name()));
    }
    return text;
}

}  // namespace dollytrack::manual
