#include "render/gl/egl_context.h"

#include "render/gl/context_choice.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack::gl {
namespace {

Error eglError(const std::string& what) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", eglGetError());
    return {ErrorCode::NoOpenGl, what + " (EGL error " + code + ")", {}};
}

/// An EGL display shared by several contexts: initialised by the first, terminated with the last.
class SharedDisplay {
  public:
    /// Returns nothing if the display cannot be initialised.
    static std::optional<SharedDisplay> start(EGLDisplay display) {
        const std::lock_guard lock(users().mutex);
        if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) return std::nullopt;
        ++users().count[display];
        return SharedDisplay(display);
    }
    SharedDisplay(SharedDisplay&& other) noexcept
        : display_(std::exchange(other.display_, EGL_NO_DISPLAY)) {}
    SharedDisplay& operator=(SharedDisplay&&) = delete;
    ~SharedDisplay() {
        if (display_ == EGL_NO_DISPLAY) return;
        const std::lock_guard lock(users().mutex);
        if (--users().count[display_] == 0) eglTerminate(display_);
    }
    [[nodiscard]] EGLDisplay get() const { return display_; }

  private:
    struct Users {
        std::mutex mutex;
        std::map<EGLDisplay, int> count;
    };
    static Users& users() {
        static Users users;
        return users;
    }
    explicit SharedDisplay(EGLDisplay display) : display_(display) {}

    EGLDisplay display_;
};

class EglContext final : public Context {
  public:
    EglContext(SharedDisplay display, EGLContext context)
        : shared_(std::move(display)), display_(shared_.get()), context_(context) {}
    ~EglContext() override {
        if (eglGetCurrentContext() == context_) {
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        eglDestroyContext(display_, context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    Status makeCurrent() override {
        // EGL binds the API per thread.
        if (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE) {
            return {};
        }
        return tl::unexpected(eglError("the windowless OpenGL context cannot be made current"));
    }

  private:
    SharedDisplay shared_;
    EGLDisplay display_;
    EGLContext context_;
};

bool has(const char* extensions, std::string_view wanted) {
    if (extensions == nullptr) return false;
    std::istringstream words(extensions);
    return std::find(std::istream_iterator<std::string>(words), {}, wanted) !=
           std::istream_iterator<std::string>();
}

std::string stringOf(PFNEGLQUERYDEVICESTRINGEXTPROC query, EGLDeviceEXT device, EGLint name) {
    const char* text = query(device, name);
    return text == nullptr ? std::string() : text;
}

/// Opens a context on one display.
Result<std::unique_ptr<Context>> openOn(EGLDisplay display, const ContextCheck& check) {
    if (display == EGL_NO_DISPLAY) return tl::unexpected(eglError("not offered"));
    std::optional<SharedDisplay> shared = SharedDisplay::start(display);
    if (!shared) return tl::unexpected(eglError("does not start"));
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
        return tl::unexpected(eglError("has no OpenGL 4.5"));
    }
    std::unique_ptr<Context> opened = std::make_unique<EglContext>(std::move(*shared), context);
    if (check) {
        if (Status status = check(*opened); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    return opened;
}

/// One choice per graphics card, in the driver's order.
std::vector<ContextChoice> graphicsCards(const ContextCheck& check) {
    std::vector<ContextChoice> cards;
    if (!has(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_EXT_platform_device")) {
        return cards;
    }
    const auto query_devices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto query_string = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
        eglGetProcAddress("eglQueryDeviceStringEXT"));
    if (query_devices == nullptr || query_string == nullptr) return cards;
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (query_devices(devices.size(), devices.data(), &count) == EGL_FALSE) return cards;
    for (EGLDeviceEXT device : std::span(devices).first(count)) {
        const std::string extensions = stringOf(query_string, device, EGL_EXTENSIONS);
        // Mesa's software driver is listed as a device, too.
        if (has(extensions.c_str(), "EGL_MESA_device_software")) continue;
        std::string name = "graphics card " + std::to_string(cards.size() + 1);
        if (has(extensions.c_str(), "EGL_EXT_device_drm")) {
            name += ", " + stringOf(query_string, device, EGL_DRM_DEVICE_FILE_EXT);
        }
        cards.push_back({std::move(name), [device, check] {
                             return openOn(
                                 eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                                 check);
                         }});
    }
    return cards;
}

}  // namespace

Result<std::unique_ptr<Context>> createEglContext(const ContextCheck& check) {
    std::vector<ContextChoice> choices = graphicsCards(check);
    choices.push_back({"Mesa without a card", [&check] {
                           return openOn(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                                               EGL_DEFAULT_DISPLAY, nullptr),
                                         check);
                       }});
    Result<std::unique_ptr<Context>> context = openFirst(choices);
    if (!context) {
        context.error().message +=
            "; install libegl1 and libegl-mesa0, or update the graphics driver";
    }
    return context;
}

}  // namespace dollytrack::gl
