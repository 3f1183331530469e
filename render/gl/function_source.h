#pragma once

#include "engine/core/result.h"

namespace dollytrack::gl {

/// Finds an OpenGL function of the driver by its name; null when it has none.
using FunctionSource = void (*(*)(const char* name))();

/// From now on all OpenGL functions of this process are those of the source, whose context must be
/// current; nothing changes if they are already. A program that may draw with one driver or another
/// has no linker to choose for it. One thread at a time may draw where contexts of several drivers
/// are open. Returns NoOpenGl if the driver lacks OpenGL 4.5.
[[nodiscard]] Status useFunctionsOf(FunctionSource source);

}  // namespace dollytrack::gl
