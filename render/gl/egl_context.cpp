#include "render/gl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdio>
#include <string>

namespace dollytrack::gl {
namespace {

Error eglError(const std::string& what) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", eglGetError());
    return {ErrorCode::NoOpenGl, what + " (EGL error " + code + ")", {}};
}

class EglContext final : public Context {
  public:
    EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    ~EglContext() override {
        if (eglGetCurrentContext() == context_) {
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    Status makeCurrent() override {
        // Each thread chooses its API for itself.
        if (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE) {
            return {};
        }
        return tl::unexpected(eglError("the windowless OpenGL context cannot be made current"));
    }

  private:
    EGLDisplay display_;
    EGLContext context_;
};

}  // namespace

Result<std::unique_ptr<Context>> createEglContext() {
    const EGLDisplay display =
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
        return tl::unexpected(
            eglError("no OpenGL without a window: the driver's EGL does not "
                     "offer it; install libegl1 and libegl-mesa0"));
    }
    constexpr std::array<EGLint, 7> kVersion = {EGL_CONTEXT_MAJOR_VERSION,
                                                4,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                5,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                EGL_NONE};
    EGLContext context = EGL_NO_CONTEXT;
    if (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE) {
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kVersion.data());
    }
    if (context == EGL_NO_CONTEXT) {
        Error error = eglError("no OpenGL 4.5 without a window; update the graphics driver");
        eglTerminate(display);
        return tl::unexpected(std::move(error));
    }
    return std::unique_ptr<Context>(std::make_unique<EglContext>(display, context));
}

}  // namespace dollytrack::gl
