#pragma once

#include "render/gl/context.h"

#include <memory>

namespace dollytrack::gl {

/// A windowless context drawn by the processor (Mesa's OSMesa), current on the calling thread and
/// with its functions loaded. Needs no display. Only programs that link `dollytrack_headless` have
/// it.
[[nodiscard]] Result<std::unique_ptr<Context>> createOsMesaContext();

}  // namespace dollytrack::gl
