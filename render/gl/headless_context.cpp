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

/// An EGL context that redirects all OpenGL calls to its own driver whenever it is made current.
/// The editor's window draws with libGL's functions, so it uses EglContext itself.
class LoadedEglContext final : public Context {
  public:
    explicit LoadedEglContext(std::unique_ptr<Context> context) : context_(std::move(context)) {}
    Status makeCurrent() override {
        if (Status status = context_->makeCurrent(); !status) return status;
        return useFunctionsOf(&eglGetProcAddress);
    }

  private:
    std::unique_ptr<Context> context_;
};

Result<std::unique_ptr<Context>> createLoadedEglContext() {
    auto context = createEglContext([](Context& opened) -> Status {
        if (Status status = opened.makeCurrent(); !status) return status;
        return useFunctionsOf(&eglGetProcAddress);
    });
    if (!context) return context;
    return std::make_unique<LoadedEglContext>(std::move(*context));
}

/// Looks for device files, because asking the drivers takes a tenth of a second.
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
        log::warn("render", "the GPU is not used: " + context.error().message);
    }
    return createOsMesaContext();
}

}  // namespace dollytrack::gl
