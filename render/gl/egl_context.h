#pragma once

#include "render/gl/context.h"

#include <functional>
#include <memory>

namespace dollytrack::gl {

/// Whether a context that was opened works; it may make it current.
using ContextCheck = std::function<Status(Context&)>;

/// A windowless context by EGL: of the first graphics card that has one and passes the check, else
/// of Mesa's software driver. Without a check it is not current anywhere yet. It shares nothing
/// with other contexts, not even the driver's state behind them. Error: NoOpenGl, with all that was
/// tried. Only programs that link `dollytrack_egl` have it.
[[nodiscard]] Result<std::unique_ptr<Context>> createEglContext(const ContextCheck& check = {});

}  // namespace dollytrack::gl
