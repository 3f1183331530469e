#pragma once

#include "render/gl/context.h"

#include <functional>
#include <memory>
#include <span>
#include <string>

namespace dollytrack::gl {

/// Something that may draw, by the name that people know it by.
struct ContextChoice {
    std::string name;
    std::function<Result<std::unique_ptr<Context>>()> open;
};

/// The first that opens; those after it are not tried. Error: NoOpenGl, a sentence with all that
/// were tried and why each did not open.
[[nodiscard]] Result<std::unique_ptr<Context>> openFirst(std::span<const ContextChoice> choices);

}  // namespace dollytrack::gl
