#include "render/gl/function_source.h"

#include "render/gl/context.h"

#include <GL/glew.h>

#include <string_view>

// GLEW looks up functions with glXGetProcAddressARB, except those of OpenGL 1.1, which GLEW and
// this program call directly in libGL. The definitions below replace libGL's.
namespace {

struct Functions {
    dollytrack::gl::FunctionSource source = nullptr;
    decltype(&glBlendFunc) blendFunc = nullptr;
    decltype(&glClear) clear = nullptr;
    decltype(&glClearColor) clearColor = nullptr;
    decltype(&glDeleteTextures) deleteTextures = nullptr;
    decltype(&glDepthFunc) depthFunc = nullptr;
    decltype(&glDepthMask) depthMask = nullptr;
    decltype(&glDepthRange) depthRange = nullptr;
    decltype(&glDisable) disable = nullptr;
    decltype(&glDrawArrays) drawArrays = nullptr;
    decltype(&glDrawElements) drawElements = nullptr;
    decltype(&glEnable) enable = nullptr;
    decltype(&glFinish) finish = nullptr;
    decltype(&glFrontFace) frontFace = nullptr;
    decltype(&glGetError) getError = nullptr;
    decltype(&glGetIntegerv) getIntegerv = nullptr;
    decltype(&glGetString) getString = nullptr;
    decltype(&glPixelStorei) pixelStorei = nullptr;
    decltype(&glScissor) scissor = nullptr;
    decltype(&glViewport) viewport = nullptr;
};

Functions functions;

template <class Function>
void find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(functions.source(name));
}

}  // namespace

namespace dollytrack::gl {

Status useFunctionsOf(FunctionSource source) {
    if (functions.source == source) return {};
    functions.source = source;
    find(functions.blendFunc, "glBlendFunc");
    find(functions.clear, "glClear");
    find(functions.clearColor, "glClearColor");
    find(functions.deleteTextures, "glDeleteTextures");
    find(functions.depthFunc, "glDepthFunc");
    find(functions.depthMask, "glDepthMask");
    find(functions.depthRange, "glDepthRange");
    find(functions.disable, "glDisable");
    find(functions.drawArrays, "glDrawArrays");
    find(functions.drawElements, "glDrawElements");
    find(functions.enable, "glEnable");
    find(functions.finish, "glFinish");
    find(functions.frontFace, "glFrontFace");
    find(functions.getError, "glGetError");
    find(functions.getIntegerv, "glGetIntegerv");
    find(functions.getString, "glGetString");
    find(functions.pixelStorei, "glPixelStorei");
    find(functions.scissor, "glScissor");
    find(functions.viewport, "glViewport");
    Status status = loadFunctions();
    if (!status) functions.source = nullptr;
    return status;
}

}  // namespace dollytrack::gl

// Exported, so that shared libraries call these functions instead of libGL's.
#pragma GCC visibility push(default)
extern "C" {

void (*glXGetProcAddressARB(const GLubyte* name))(void);
void (*glXGetProcAddressARB(const GLubyte* name))(void) {
    const std::string_view text(reinterpret_cast<const char*>(name));
    // There is no X server: GLX functions must not be found, or GLEW would call them.
    return text.starts_with("glX") ? nullptr : functions.source(text.data());
}

void glBlendFunc(GLenum source, GLenum target) {
    functions.blendFunc(source, target);
}
void glClear(GLbitfield images) {
    functions.clear(images);
}
void glClearColor(GLclampf red, GLclampf green, GLclampf blue, GLclampf alpha) {
    functions.clearColor(red, green, blue, alpha);
}
void glDeleteTextures(GLsizei count, const GLuint* textures) {
    functions.deleteTextures(count, textures);
}
void glDepthFunc(GLenum function) {
    functions.depthFunc(function);
}
void glDepthMask(GLboolean flag) {
    functions.depthMask(flag);
}
void glDepthRange(GLclampd near, GLclampd far) {
    functions.depthRange(near, far);
}
void glDisable(GLenum what) {
    functions.disable(what);
}
void glDrawArrays(GLenum mode, GLint first, GLsizei count) {
    functions.drawArrays(mode, first, count);
}
void glDrawElements(GLenum mode, GLsizei count, GLenum type, const void* indices) {
    functions.drawElements(mode, count, type, indices);
}
void glEnable(GLenum what) {
    functions.enable(what);
}
void glFinish(void) {
    functions.finish();
}
void glFrontFace(GLenum mode) {
    functions.frontFace(mode);
}
GLenum glGetError(void) {
    return functions.getError();
}
void glGetIntegerv(GLenum name, GLint* values) {
    functions.getIntegerv(name, values);
}
const GLubyte* glGetString(GLenum name) {
    return functions.getString(name);
}
void glPixelStorei(GLenum name, GLint value) {
    functions.pixelStorei(name, value);
}
void glScissor(GLint x, GLint y, GLsizei width, GLsizei height) {
    functions.scissor(x, y, width, height);
}
void glViewport(GLint x, GLint y, GLsizei width, GLsizei height) {
    functions.viewport(x, y, width, height);
}

}  // extern "C"
#pragma GCC visibility pop
