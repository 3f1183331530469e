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
    ValuesByOption values;                    // option values for shell completion
    std::map<std::string, std::string> more;  // more troff text, by subcommand; "": program
};

/// Writes man1/*.1, bash/PROGRAM, zsh/_PROGRAM and fish/PROGRAM.fish into a folder, generated from
/// the program's option definitions. Error: CannotWrite.
[[nodiscard]] Status writeManual(const CLI::App& program, const ManualSettings& settings,
                                 const std::filesystem::path& folder);

/// A hidden option with a folder as value: the program writes its manual there and exits. Used by
/// the build.
inline constexpr const char* kManualOption = "--write-manual";

}  // namespace dollytrack::manual
