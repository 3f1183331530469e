#include "engine/core/program_file.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRunningProgram = "/proc/self/exe";

/// The name by which the library with this code was loaded; empty in a program.
std::string loadedAs() {
    Dl_info info{};
    link_map* map = nullptr;
    const bool known = dladdr1(reinterpret_cast<const void*>(&ownFile), &info,
                               reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
    // The name is empty for the program itself; for a library it is the name it was loaded by.
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
    // Stored once, because a relative name refers to the current folder at the time of loading.
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
