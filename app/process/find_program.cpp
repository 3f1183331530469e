#include "app/process/find_program.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <system_error>

namespace dollytrack {

namespace fs = std::filesystem;

std::optional<fs::path> findProgram(const std::string& name) {
    const char* folders = std::getenv("PATH");
    std::istringstream list(folders != nullptr ? folders : "/usr/bin:/bin");
    for (std::string folder; std::getline(list, folder, ':');) {
        const fs::path program = fs::path(folder) / name;
        std::error_code error;
        if (fs::path(folder).is_absolute() && ::access(program.c_str(), X_OK) == 0 &&
            fs::is_regular_file(program, error)) {
            fs::path real = fs::canonical(program, error);
            if (!error) return real;
        }
    }
    return std::nullopt;
}

}  // namespace dollytrack
