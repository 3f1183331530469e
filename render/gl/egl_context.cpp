#include "render/gl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

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

bool has(const char* extensions, std::string_view wanted) {
    if (extensions == nullptr) return false;
    std::istringstream words(extensions);
    return std::find(std::istream_iterator<std::string>(words), {}, wanted) !=
           std::istream_iterator<std::string>();
}

/// The first graphics card that lets itself be used without a window.
EGLDisplay openGraphicsCard() {
    if (!has(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_EXT_platform_device")) {
        return EGL_NO_DISPLAY;
    }
    const auto query_devices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto query_string = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
        eglGetProcAddress("eglQueryDeviceStringEXT"));
    if (query_devices == nullptr || query_string == nullptr) return EGL_NO_DISPLAY;
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (query_devices(devices.size(), devices.data(), &count) == EGL_FALSE) return EGL_NO_DISPLAY;
    for (EGLDeviceEXT device : std::span(devices).first(static_cast<std::size_t>(count))) {
        // Mesa's software driver is a device, too.
        if (has(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
        const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) {
            return display;
        }
    }
    return EGL_NO_DISPLAY;
}

EGLDisplay openDisplay() {
    if (const EGLDisplay card = openGraphicsCard(); card != EGL_NO_DISPLAY) return card;
    const EGLDisplay mesa =
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (mesa == EGL_NO_DISPLAY || eglInitialize(mesa, nullptr, nullptr) == EGL_FALSE) {
        return EGL_NO_DISPLAY;
    }
    return mesa;
}

}  // namespace

Result<std::unique_ptr<Context>> createEglContext() {
    const EGLDisplay display = openDisplay();
    if (display == EGL_NO_DISPLAY) {
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
