#pragma once

#include "engine/core/result.h"

#include <string>

namespace dollytrack::gl {

/// An OpenGL 4.5 core context, with or without a window. Only one thread may use it at a time.
class Context {
  public:
    virtual ~Context() = default;
    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes the context current on the calling thread. Returns NoOpenGl if that fails.
    [[nodiscard]] virtual Status makeCurrent() = 0;
};

/// Loads the OpenGL entry points for the current context. Returns NoOpenGl, naming the version
/// found, if the driver offers less than OpenGL 4.5.
[[nodiscard]] Status loadFunctions();

/// Whether the current context renders on the CPU (Mesa's llvmpipe) instead of a graphics card.
[[nodiscard]] bool drawsByProcessor();

/// Renderer and version of the current context, for example "llvmpipe (LLVM 15.0.6, 256 bits),
/// OpenGL 4.5"; "none" if the driver does not answer.
[[nodiscard]] std::string rendererName();

/// Returns Failed if an OpenGL error is pending in the current context; the message names `during`,
/// the step that just ran ("loading the scene").
[[nodiscard]] Status checkErrors(const std::string& during);

}  // namespace dollytrack::gl
