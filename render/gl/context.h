#pragma once

#include "engine/core/result.h"

#include <string>

namespace dollytrack::gl {

/// An OpenGL 4.5 core context of some windowing system, or of none. One thread at a time.
class Context {
  public:
    virtual ~Context() = default;
    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes it the calling thread's context. NoOpenGl when that fails.
    [[nodiscard]] virtual Status makeCurrent() = 0;
};

/// Loads the entry points for the current context and checks that it is at least 4.5. NoOpenGl
/// with the version found when it is not.
[[nodiscard]] Status loadFunctions();

/// Whether the current context has no graphics card.
[[nodiscard]] bool drawsByProcessor();

/// "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5" of the current context.
[[nodiscard]] std::string rendererName();

/// An error pending in the current context, as a Failed naming `during`.
[[nodiscard]] Status checkErrors(const std::string& during);

}  // namespace dollytrack::gl
