#pragma once

#include "render/gl/context.h"

#include <memory>

namespace dollytrack::gl {

/// A windowless context by EGL, on the graphics card where there is one; not current anywhere yet.
/// It shares nothing with other contexts, not even the driver's state behind them. Only programs
/// that link `dollytrack_egl` have it.
[[nodiscard]] Result<std::unique_ptr<Context>> createEglContext();

}  // namespace dollytrack::gl
