#include "render/gl/osmesa_context.h"

#include "engine/core/shared_library.h"
#include "render/gl/function_source.h"

#include <GL/glew.h>

// GLEW undefines macros that Mesa's header expects from GL/gl.h.
#define GLAPI extern "C"
#ifndef GLAPIENTRY
#define GLAPIENTRY
#endif
#include <GL/osmesa.h>

#include <array>
#include <optional>

namespace dollytrack::gl {
namespace {

struct OsMesaFunctions {
    decltype(&::OSMesaCreateContextAttribs) create = nullptr;
    decltype(&::OSMesaDestroyContext) destroy = nullptr;
    decltype(&::OSMesaMakeCurrent) make_current = nullptr;
    decltype(&::OSMesaGetProcAddress) proc_address = nullptr;
};

/// Loads the library once; empty if it is missing.
const std::optional<OsMesaFunctions>& osMesa() {
    static const std::optional<OsMesaFunctions> functions = [] {
        std::optional<OsMesaFunctions> loaded(std::in_place);
        void* library = openSharedLibrary(DOLLYTRACK_OSMESA);
        if (library == nullptr ||
            !findSymbol(library, "OSMesaCreateContextAttribs", loaded->create) ||
            !findSymbol(library, "OSMesaDestroyContext", loaded->destroy) ||
            !findSymbol(library, "OSMesaMakeCurrent", loaded->make_current) ||
            !findSymbol(library, "OSMesaGetProcAddress", loaded->proc_address)) {
            loaded.reset();
        }
        return loaded;
    }();
    return functions;
}

class OsMesaContext final : public Context {
  public:
    explicit OsMesaContext(OSMesaContext context) : context_(context) {}
    ~OsMesaContext() override { osMesa()->destroy(context_); }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;

    Status makeCurrent() override {
        // The default framebuffer is never drawn to; its size does not matter.
        if (osMesa()->make_current(context_, pixels_.data(), GL_UNSIGNED_BYTE, 4, 4) == GL_FALSE) {
            return fail(ErrorCode::NoOpenGl,
                        "the windowless OpenGL context (OSMesa) cannot be made current");
        }
        return useFunctionsOf(osMesa()->proc_address);
    }

  private:
    OSMesaContext context_;
    std::array<unsigned char, 64> pixels_{};
};

}  // namespace

Result<std::unique_ptr<Context>> createOsMesaContext() {
    const std::array<int, 13> attributes = {OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_DEPTH_BITS,
                                            0,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            4,
                                            OSMESA_CONTEXT_MINOR_VERSION,
                                            5,
                                            0,
                                            0,
                                            0};
    OSMesaContext raw = osMesa() ? osMesa()->create(attributes.data(), nullptr) : nullptr;
    if (raw == nullptr) {
        return fail(ErrorCode::NoOpenGl,
                    "OpenGL 4.5 without a display is not available; install Mesa's libosmesa6, or "
                    "unset GALLIUM_DRIVER and LIBGL variables");
    }
    auto context = std::make_unique<OsMesaContext>(raw);
    if (Status status = context->makeCurrent(); !status) return tl::unexpected(status.error());
    return context;
}

}  // namespace dollytrack::gl
