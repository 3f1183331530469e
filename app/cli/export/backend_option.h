#pragma once

#include "render/gl/headless_context.h"

#include <string>

namespace CLI {
class App;
}

namespace dollytrack::cli {

/// The option --gl auto|egl|osmesa of commands that render.
struct BackendOption {
    std::string name = "auto";

    [[nodiscard]] Result<std::unique_ptr<gl::Context>> createContext() const;
};

void addBackendOption(CLI::App& command, BackendOption& option);

}  // namespace dollytrack::cli
