#include "app/manual/command_words.h"

#include <CLI/CLI.hpp>

#include <sstream>
#include <string_view>

namespace dollytrack::manual {
namespace {

/// The values listed in a type: "auto", "egl" for "TEXT:{auto,egl}".
std::vector<std::string> listedValues(const std::string& type) {
    const std::size_t begin = type.find(":{");
    const std::size_t end = type.find('}', begin);
    if (begin == std::string::npos || end == std::string::npos) return {};
    std::vector<std::string> values;
    std::istringstream list(type.substr(begin + 2, end - begin - 2));
    for (std::string value; std::getline(list, value, ',');) values.push_back(value);
    return values;
}

bool startsWithAny(std::string_view text, std::initializer_list<std::string_view> beginnings) {
    for (const std::string_view beginning : beginnings) {
        if (text.starts_with(beginning)) return true;
    }
    return false;
}

ValueWords valueOf(const CLI::Option& option, const ValuesByOption& known) {
    using Kind = ValueWords::Kind;
    if (option.get_items_expected_max() == 0) return {};
    const std::string type = option.get_type_name();
    if (std::vector<std::string> values = listedValues(type); !values.empty()) {
        return {Kind::Known, {std::move(values), false}};
    }
    for (const std::string& name : option.get_lnames()) {
        if (const auto found = known.find("--" + name); found != known.end()) {
            return {Kind::Known, found->second};
        }
    }
    if (startsWithAny(type, {"DIR"})) return {Kind::Folder, {}};
    const bool file = startsWithAny(type, {"FILE", "SCENE", "PLY", "PATH", "JOBS"});
    return {file ? Kind::File : Kind::Anything, {}};
}

CommandWords wordsOf(const CLI::App& command, const ValuesByOption& known) {
    CommandWords words;
    words.text = command.get_description();
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) {
            if (words.argument.kind == ValueWords::Kind::None) {
                words.argument = valueOf(*option, known);
            }
            continue;
        }
        OptionWords one;
        for (const std::string& name : option->get_snames()) one.names.push_back("-" + name);
        for (const std::string& name : option->get_lnames()) one.names.push_back("--" + name);
        one.text = option->get_description();
        one.type = option->get_type_name();
        one.type = one.type.substr(0, one.type.find(":{"));
        one.value = valueOf(*option, known);
        words.options.push_back(std::move(one));
    }
    return words;
}

}  // namespace

std::vector<CommandWords> commandWords(const CLI::App& program, const ValuesByOption& known) {
    std::vector<CommandWords> all = {wordsOf(program, known)};
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        all.push_back(wordsOf(*command, known));
        all.back().name = command->get_name();
    }
    return all;
}

}  // namespace dollytrack::manual
