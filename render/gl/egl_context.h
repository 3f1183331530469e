#pragma once

#include "render/gl/context.h"

#include <functional>
#include <memory>

namespace dollytrack::gl {

/// Checks a context that was just opened. The check may make the context current.
using ContextCheck = std::function<Status(Context&)>;

/// Opens a windowless EGL context on the first graphics card whose context passes `check`, or on
/// Mesa's software driver if no card does. Without a check the context is not made current. It
/// shares no objects with other contexts. Returns NoOpenGl, listing all devices tried, if none
/// opens. Only programs that link `dollytrack_egl` have this function.
[[nodiscard]] Result<std::unique_ptr<Context>> createEglContext(const ContextCheck& check = {});

}  // namespace dollytrack::gl
