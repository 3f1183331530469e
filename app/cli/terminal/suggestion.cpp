#include "app/cli/terminal/suggestion.h"

#include "engine/core/field_list.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>

namespace dollytrack::cli {
namespace {

/// The option's name: "--range" of "--range=3", "-o" of "-ofile"; empty if the argument is not an
/// option.
std::string optionName(const std::string& argument) {
    if (argument.starts_with("--")) {
        return argument.size() > 2 ? argument.substr(0, argument.find('=')) : "";
    }
    const bool is_short = argument.size() > 1 && argument[0] == '-' &&
                          std::isalpha(static_cast<unsigned char>(argument[1])) != 0;
    return is_short ? argument.substr(0, 2) : "";
}

/// Whether the option consumes the next argument.
bool takesValue(const CLI::App* app, const std::string& argument) {
    const bool holds_it = argument.find('=') != std::string::npos ||
                          (!argument.starts_with("--") && argument.size() > 2);
    if (app == nullptr || holds_it) return false;
    const CLI::Option* option = app->get_option_no_throw(optionName(argument));
    return option != nullptr && option->get_items_expected_max() > 0;
}

/// Names of more than one letter: any two single letters would be similar.
std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

bool isKnown(const CLI::App* app, const std::string& name) {
    return app != nullptr && app->get_option_no_throw(name) != nullptr;
}

std::string sentence(const char* kind, const std::string& wrong,
                     const std::vector<std::string>& names) {
    const std::string close = closestName(wrong, names);
    return close.empty()
               ? fmt::format("There is no {} '{}'.", kind, wrong)
               : fmt::format("There is no {} '{}'; did you mean '{}'?", kind, wrong, close);
}

/// Whether an option takes whole numbers, judged by its value's type name in the help.
bool wantsWholeNumber(const CLI::App& app, const std::string& name) {
    std::vector<const CLI::App*> all = app.get_subcommands([](const CLI::App*) { return true; });
    all.push_back(&app);
    return std::ranges::any_of(all, [&](const CLI::App* one) {
        const CLI::Option* option = one->get_option_no_throw(name);
        if (option == nullptr) return false;
        const std::string type = option->get_type_name();
        return type == "N" || type.starts_with("INT");
    });
}

}  // namespace

std::string explainUnknownName(const CLI::App& app, const std::vector<std::string>& arguments) {
    const std::vector<const CLI::App*> all =
        app.get_subcommands([](const CLI::App*) { return true; });
    std::vector<std::string> subcommands;
    for (const CLI::App* one : all) subcommands.push_back(one->get_name());
    const CLI::App* command = nullptr;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if (argument == "--") break;
        const std::string name = optionName(argument);
        if (name.empty()) {
            if (command != nullptr) continue;  // a positional value
            const auto found = std::find(subcommands.begin(), subcommands.end(), argument);
            if (found == subcommands.end()) return sentence("subcommand", argument, subcommands);
            command = all[found - subcommands.begin()];
            continue;
        }
        if (!isKnown(&app, name) && !isKnown(command, name)) {
            std::vector<std::string> names = optionNames(app);
            if (command != nullptr) {
                const std::vector<std::string> own = optionNames(*command);
                names.insert(names.end(), own.begin(), own.end());
            }
            return sentence("option", name, names);
        }
        if (takesValue(&app, argument) || takesValue(command, argument)) ++i;
    }
    return {};
}

std::string explainRefusal(const CLI::App& app, const CLI::ParseError& error) {
    const std::string words = error.what();
    const auto after = [&](std::string_view mark) {
        const std::size_t at = words.find(mark);
        return at == std::string::npos ? std::string() : words.substr(at + mark.size());
    };
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
        // Message format: "Could not convert: --seed = x". All converted options are numbers.
        const std::string value = after(" = ");
        const std::string name = after("Could not convert: ").substr(0, after(": ").find(" = "));
        if (value.empty()) return words;
        const bool whole = wantsWholeNumber(app, name);
        return fmt::format("'{}' is not a {}number, but {} needs one.", value,
                           whole ? "whole " : "", name);
    }
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        const std::string extra = after("expected: ");
        if (extra.empty()) return words;
        return extra.find('=') != std::string::npos && !extra.starts_with('-')
                   ? fmt::format("'{}' is not expected here; repeat --set before each parameter.",
                                 extra)
                   : fmt::format("'{}' is not expected here.", extra);
    }
    return words;
}

}  // namespace dollytrack::cli
