#include "app/cli/export/backend_option.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <vector>

namespace dollytrack::cli {

Result<std::unique_ptr<gl::Context>> BackendOption::createContext() const {
    const auto found = std::ranges::find(gl::kBackendNames, name);  // validated by the option
    return gl::createHeadlessContext(static_cast<gl::Backend>(found - gl::kBackendNames.begin()));
}

void addBackendOption(CLI::App& command, BackendOption& option) {
    command
        .add_option("--gl", option.name,
                    "OpenGL backend: egl (GPU), osmesa (CPU) or auto (egl if there is a GPU)")
        ->check(CLI::IsMember(
            std::vector<std::string>(gl::kBackendNames.begin(), gl::kBackendNames.end())));
}

}  // namespace dollytrack::cli
