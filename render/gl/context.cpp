#include "render/gl/context.h"

#include <GL/glew.h>

#include <cstdio>

namespace dollytrack::gl {

Status loadFunctions() {
    glewExperimental = GL_TRUE;
    // Without GLX, GLEW returns an error although it has loaded everything, so its result is
    // ignored and the loaded functions are checked below.
    glewInit();
    while (glGetError() != GL_NO_ERROR) {
    }
    int major = 0;
    int minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (10 * major + minor < 45 || glCreateFramebuffers == nullptr || glClipControl == nullptr) {
        return fail(ErrorCode::NoOpenGl, "OpenGL 4.5 is needed, this driver offers " +
                                             std::to_string(major) + "." + std::to_string(minor) +
                                             "; update the graphics driver or Mesa");
    }
    return {};
}

bool drawsByProcessor() {
    return rendererName().find("llvmpipe") != std::string::npos;
}

std::string rendererName() {
    const GLubyte* name = glGetString(GL_RENDERER);
    const GLubyte* version = glGetString(GL_VERSION);
    if (name == nullptr || version == nullptr) return "none";
    return std::string(reinterpret_cast<const char*>(name)) + ", OpenGL " +
           reinterpret_cast<const char*>(version);
}

Status checkErrors(const std::string& during) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return {};
    if (error == GL_OUT_OF_MEMORY) {
        return fail(ErrorCode::Failed, "out of graphics memory while " + during +
                                           "; use smaller images or a smaller scene");
    }
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", error);
    return fail(ErrorCode::Failed,
                "OpenGL reports error " + std::string(code) + " while " + during);
}

}  // namespace dollytrack::gl
