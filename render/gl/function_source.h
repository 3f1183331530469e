#pragma once

#include "engine/core/result.h"

namespace dollytrack::gl {

/// Looks up an OpenGL function of a driver by name; returns null if the driver lacks it.
using FunctionSource = void (*(*)(const char* name))();

/// Redirects all OpenGL calls of this process to the functions of `source`, whose context must be
/// current. Does nothing if `source` is already in use. Programs that choose their driver at run
/// time need this because the linker cannot choose for them. If contexts of several drivers are
/// open, only one thread at a time may draw. Returns NoOpenGl if the driver lacks OpenGL 4.5.
[[nodiscard]] Status useFunctionsOf(FunctionSource source);

}  // namespace dollytrack::gl
