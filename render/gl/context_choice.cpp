#include "render/gl/context_choice.h"

#include <utility>

namespace dollytrack::gl {

Result<std::unique_ptr<Context>> openFirst(std::span<const ContextChoice> choices) {
    std::string tried;
    for (const ContextChoice& choice : choices) {
        Result<std::unique_ptr<Context>> context = choice.open();
        if (context) return context;
        tried += (tried.empty() ? "" : ", ") + choice.name + " (" + context.error().message + ")";
    }
    return fail(ErrorCode::NoOpenGl,
                "no OpenGL driver can render without a window; " +
                    (tried.empty() ? std::string("none is available") : "tried: " + tried));
}

}  // namespace dollytrack::gl
