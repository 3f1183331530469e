#pragma once

#include "app/manual/command_words.h"
#include "engine/core/result.h"

#include <filesystem>
#include <string>

namespace CLI {
class App;
}

namespace dollytrack::manual {

struct ManualSettings {
    std::string version;
    ValuesByOption values;                    // completed in shells
    std::map<std::string, std::string> more;  // troff, by subcommand; empty name: the program
};

/// Writes man1/*.1, bash/PROGRAM, zsh/_PROGRAM and fish/PROGRAM.fish into a folder, from the
/// definitions of a program's options. Error: CannotWrite.
[[nodiscard]] Status writeManual(const CLI::App& program, const ManualSettings& settings,
                                 const std::filesystem::path& folder);

/// A hidden option, with a folder: the program writes its manual there and ends. The build uses it.
inline constexpr const char* kManualOption = "--write-manual";

}  // namespace dollytrack::manual
