#include "engine/core/program_file.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRunningProgram = "/proc/self/exe";

/// The name by which the library that holds this code was loaded; empty in a program.
std::string loadedAs() {
    Dl_info info{};
    link_map* map = nullptr;
    const bool known = dladdr1(reinterpret_cast<const void*>(&ownFile), &info,
                               reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
    // The program itself has no name here. A library has the one it was loaded by.
    return known && map != nullptr && map->l_name != nullptr ? map->l_name : "";
}

fs::path findOwnFile() {
    std::error_code error;
    const std::string library = loadedAs();
    return library.empty() ? fs::read_symlink(kRunningProgram, error)
                           : fs::canonical(library, error);
}

}  // namespace

fs::path ownFile() {
    // Kept: a relative name is of the folder that was the current one when the library was loaded.
    static const fs::path file = findOwnFile();
    return file;
}

fs::path ownContent() {
    static const bool is_library = !loadedAs().empty();
    return is_library ? ownFile() : fs::path(kRunningProgram);
}

fs::path siblingProgram(const std::string& name) {
    std::error_code error;
    fs::path beside = ownFile().parent_path() / name;
    if (fs::exists(beside, error)) return beside;
    fs::path installed = fs::path(DOLLYTRACK_PROGRAM_FOLDER) / name;
    return fs::exists(installed, error) ? installed : beside;
}

}  // namespace dollytrack
