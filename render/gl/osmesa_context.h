#pragma once

#include "render/gl/context.h"

#include <memory>

namespace dollytrack::gl {

/// Opens a windowless context that renders on the CPU (Mesa's OSMesa), makes it current on the
/// calling thread and loads its functions. Needs no display. Returns NoOpenGl if OSMesa is not
/// installed or offers no OpenGL 4.5. Only programs that link `dollytrack_headless` have this
/// function.
[[nodiscard]] Result<std::unique_ptr<Context>> createOsMesaContext();

}  // namespace dollytrack::gl
