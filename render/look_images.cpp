#include "render/look_images.h"

#include <GL/glew.h>

namespace dollytrack::render {
namespace {

gl::Texture createSamples(unsigned format, int width, int height) {
    gl::Texture texture = gl::createTexture(GL_TEXTURE_2D_MULTISAMPLE);
    glTextureStorage2DMultisample(texture.get(), LookImages::kLooks, format, width, height,
                                  GL_TRUE);
    return texture;
}

}  // namespace

void LookImages::resize(int width, int height) {
    if (width == width_ && height == height_) return;
    width_ = width;
    height_ = height;
    color_ = createSamples(GL_RGBA8, width, height);
    normal_ = createSamples(GL_RGBA16_SNORM, width, height);
    depth_ = createSamples(GL_DEPTH_COMPONENT32F, width, height);
    frame_ = gl::createFramebuffer();
    const unsigned frame = frame_.get();
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, color_.get(), 0);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT1, normal_.get(), 0);
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, depth_.get(), 0);
    constexpr std::array<GLenum, 2> kOutputs = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(frame, kOutputs.size(), kOutputs.data());
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    for (unsigned i = 0; i < offsets_.size(); ++i) {
        std::array<float, 2> place{};
        glGetMultisamplefv(GL_SAMPLE_POSITION, i, place.data());
        offsets_[i] = {place[0] - 0.5, place[1] - 0.5};
    }
}

}  // namespace dollytrack::render
