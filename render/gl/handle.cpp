#include "render/gl/handle.h"

#include <GL/glew.h>

namespace dollytrack::gl {

void destroyBuffer(unsigned name) {
    glDeleteBuffers(1, &name);
}
void destroyTexture(unsigned name) {
    glDeleteTextures(1, &name);
}
void destroyFramebuffer(unsigned name) {
    glDeleteFramebuffers(1, &name);
}
void destroyVertexArray(unsigned name) {
    glDeleteVertexArrays(1, &name);
}
void destroyProgram(unsigned name) {
    glDeleteProgram(name);
}
void destroyQuery(unsigned name) {
    glDeleteQueries(1, &name);
}

Buffer createBuffer() {
    unsigned name = 0;
    glCreateBuffers(1, &name);
    return Buffer(name);
}

Texture createTexture(unsigned target) {
    unsigned name = 0;
    glCreateTextures(target, 1, &name);
    return Texture(name);
}

Framebuffer createFramebuffer() {
    unsigned name = 0;
    glCreateFramebuffers(1, &name);
    return Framebuffer(name);
}

VertexArray createVertexArray() {
    unsigned name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArray(name);
}

Query createQuery(unsigned target) {
    unsigned name = 0;
    glCreateQueries(target, 1, &name);
    return Query(name);
}

}  // namespace dollytrack::gl
