#pragma once

#include "render/gl/context.h"

#include <array>
#include <memory>
#include <string_view>

namespace dollytrack::gl {

/// Driver for drawing without a window.
enum class Backend {
    Auto,    // EGL if the machine has a graphics card, else OSMesa
    Egl,     // a graphics card, or Mesa's software driver if EGL finds no card
    OsMesa,  // Mesa's software driver, without EGL
};

/// Names on the command line, in the order of Backend.
constexpr std::array<std::string_view, 3> kBackendNames = {"auto", "egl", "osmesa"};

/// Opens a windowless context, makes it current on the calling thread and loads its functions.
/// Returns NoOpenGl, with advice, if the backend is missing; Auto then logs a warning and tries
/// OSMesa. A program should use one backend only. Only programs that link `dollytrack_headless`
/// have this function.
[[nodiscard]] Result<std::unique_ptr<Context>> createHeadlessContext(Backend backend);

}  // namespace dollytrack::gl
