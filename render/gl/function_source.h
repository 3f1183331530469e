#pragma once

namespace dollytrack::gl {

/// Finds an OpenGL function of the driver by its name; null when it has none.
using FunctionSource = void (*(*)(const char* name))();

/// From now on all OpenGL functions of this program are the source's. A program that may draw with
/// one driver or another has no linker to choose for it. Load the functions again afterwards.
void takeFunctionsFrom(FunctionSource source);

}  // namespace dollytrack::gl
