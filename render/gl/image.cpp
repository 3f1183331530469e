#include "render/gl/image.h"

#include <GL/glew.h>
#include <fmt/format.h>

namespace dollytrack::gl {

Texture createImage(unsigned format, int width, int height, bool smooth) {
    const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
    Texture texture = createTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.get(), 1, format, width, height);
    glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

Status checkImageSize(const std::string& what, int width, int height) {
    int largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width >= 1 && height >= 1 && width <= largest && height <= largest) return {};
    return fail(ErrorCode::Usage,
                fmt::format("{} of {} x {} px cannot be drawn; this driver's limit is {} px", what,
                            width, height, largest));
}

}  // namespace dollytrack::gl
