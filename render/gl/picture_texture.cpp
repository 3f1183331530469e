#include "render/gl/picture_texture.h"

#include <GL/glew.h>

namespace dollytrack::gl {

void PictureTexture::upload(int width, int height, std::span<const std::uint8_t> rgba) {
    if (texture_.get() == 0 || width != width_ || height != height_) {
        texture_ = createTexture(GL_TEXTURE_2D);
        glTextureStorage2D(texture_.get(), 1, GL_RGBA8, width, height);
        glTextureParameteri(texture_.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(texture_.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTextureParameteri(texture_.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(texture_.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        width_ = width;
        height_ = height;
    }
    glTextureSubImage2D(texture_.get(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                        rgba.data());
}

void clearWindow(int width, int height, float red, float green, float blue) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glClearColor(red, green, blue, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace dollytrack::gl
