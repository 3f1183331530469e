#include "app/manual/manual_files.h"

#include "app/manual/completions.h"
#include "app/manual/man_page.h"

#include <CLI/CLI.hpp>

#include <fstream>
#include <system_error>

namespace dollytrack::manual {
namespace {

namespace fs = std::filesystem;

Status write(const fs::path& file, const std::string& text) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (out) return {};
    return fail(ErrorCode::CannotWrite, "cannot be written; give a writable folder.",
                file.string());
}

}  // namespace

Status writeManual(const CLI::App& program, const ManualSettings& settings,
                   const fs::path& folder) {
    const std::string name = program.get_name();
    const std::vector<CommandWords> words = commandWords(program, settings.values);
    std::map<fs::path, std::string> files = {
        {folder / "bash" / name, bashCompletion(name, words)},
        {folder / "zsh" / ("_" + name), zshCompletion(name, words)},
        {folder / "fish" / (name + ".fish"), fishCompletion(name, words)},
    };
    const auto addPage = [&](const CLI::App& command, const std::string& subcommand) {
        const auto more = settings.more.find(subcommand);
        files[folder / "man1" / (name + (subcommand.empty() ? "" : "-" + subcommand) + ".1")] =
            manPage(program, command, settings.version,
                    more != settings.more.end() ? more->second : std::string());
    };
    addPage(program, "");
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        addPage(*command, command->get_name());
    }
    for (const auto& [file, text] : files) {
        if (Status status = write(file, text); !status) return status;
    }
    return {};
}

}  // namespace dollytrack::manual
