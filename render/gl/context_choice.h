#pragma once

#include "render/gl/context.h"

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace dollytrack::gl {

/// A driver to try, with the name that error messages use for it.
struct ContextChoice {
    std::string name;
    std::function<Result<std::unique_ptr<Context>>()> open;
};

/// Opens the choices in order and returns the first context that opens. Returns NoOpenGl if none
/// opens; the message lists every choice with its reason.
[[nodiscard]] Result<std::unique_ptr<Context>> openFirst(std::span<const ContextChoice> choices);

}  // namespace dollytrack::gl
