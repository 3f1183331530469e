#pragma once

#include "render/gl/context.h"

#include <array>
#include <memory>
#include <string_view>

namespace dollytrack::gl {

/// What draws where there is no window.
enum class Backend {
    Auto,    // EGL where the machine has a graphics card, else OSMesa
    Egl,     // the graphics card, or Mesa's software driver where EGL offers nothing else
    OsMesa,  // Mesa's software driver, by itself
};

/// As people name them, in the enum's order.
constexpr std::array<std::string_view, 3> kBackendNames = {"auto", "egl", "osmesa"};

/// A windowless context, current on the calling thread and with its functions loaded. Only
/// programs that link `dollytrack_headless` have it; one of them keeps to one backend. NoOpenGl,
/// with what to do, where the backend is not there; Auto goes on to OSMesa then, and logs why.
[[nodiscard]] Result<std::unique_ptr<Context>> createHeadlessContext(Backend backend);

}  // namespace dollytrack::gl
