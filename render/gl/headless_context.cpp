#include "render/gl/headless_context.h"

#include "engine/core/log.h"
#include "render/gl/egl_context.h"
#include "render/gl/function_source.h"
#include "render/gl/osmesa_context.h"

#include <EGL/egl.h>

#include <filesystem>
#include <utility>

namespace dollytrack::gl {
namespace {

Result<std::unique_ptr<Context>> createLoadedEglContext() {
    return createEglContext([](Context& context) -> Status {
        if (Status status = context.makeCurrent(); !status) return status;
        takeFunctionsFrom(&eglGetProcAddress);
        return loadFunctions();
    });
}

/// Asking the drivers takes a tenth of a second; what they talk to tells as well.
bool hasGraphicsCard() {
    std::error_code error;
    if (std::filesystem::exists("/dev/nvidiactl", error)) return true;
    for (std::filesystem::directory_iterator entry("/dev/dri", error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().filename().string().starts_with("renderD")) return true;
    }
    return false;
}

}  // namespace

Result<std::unique_ptr<Context>> createHeadlessContext(Backend backend) {
    if (backend == Backend::Egl) return createLoadedEglContext();
    if (backend == Backend::Auto && hasGraphicsCard()) {
        Result<std::unique_ptr<Context>> context = createLoadedEglContext();
        if (context) return context;
        log::warn("render", "the graphics card is not used: " + context.error().message);
    }
    return createOsMesaContext();
}

}  // namespace dollytrack::gl
