#include "render/draw/passes/multisample_buffer.h"

#include "render/gl/context.h"

#include <GL/glew.h>
#include <fmt/format.h>

namespace dollytrack::render {
namespace {

gl::Texture createSamples(unsigned format, int width, int height) {
    gl::Texture texture = gl::createTexture(GL_TEXTURE_2D_MULTISAMPLE);
    glTextureStorage2DMultisample(texture.get(), MultisampleBuffer::kSamplesPerPixel, format, width,
                                  height, GL_TRUE);
    return texture;
}

}  // namespace

Result<MultisampleBuffer> MultisampleBuffer::create(int width, int height) {
    MultisampleBuffer images;
    images.color_ = createSamples(GL_RGBA8, width, height);
    images.normal_ = createSamples(GL_RGBA16_SNORM, width, height);
    images.depth_ = createSamples(GL_DEPTH_COMPONENT32F, width, height);
    images.frame_ = gl::createFramebuffer();
    const unsigned frame = images.frame_.get();
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, images.color_.get(), 0);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT1, images.normal_.get(), 0);
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, images.depth_.get(), 0);
    constexpr std::array<GLenum, 2> kOutputs = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(frame, kOutputs.size(), kOutputs.data());
    if (!gl::checkErrors("creating the multisampled images") ||
        glCheckNamedFramebufferStatus(frame, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return fail(ErrorCode::Usage,
                    fmt::format("this OpenGL driver cannot render {} samples per pixel at {} x {} "
                                "px; use antialias=edges, or a smaller image",
                                kSamplesPerPixel, width, height));
    }
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    for (unsigned i = 0; i < images.offsets_.size(); ++i) {
        std::array<float, 2> place{};
        glGetMultisamplefv(GL_SAMPLE_POSITION, i, place.data());
        images.offsets_[i] = {place[0] - 0.5, place[1] - 0.5};
    }
    return images;
}

}  // namespace dollytrack::render
