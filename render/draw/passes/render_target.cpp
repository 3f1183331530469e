#include "render/draw/passes/render_target.h"

#include "render/gl/context.h"
#include "render/gl/image.h"

#include <GL/glew.h>

#include <array>
#include <cmath>
#include <utility>

namespace dollytrack::render {
namespace {

gl::Framebuffer frameOver(const gl::Texture& texture) {
    gl::Framebuffer frame = gl::createFramebuffer();
    glNamedFramebufferTexture(frame.get(), GL_COLOR_ATTACHMENT0, texture.get(), 0);
    return frame;
}

}  // namespace

Result<RenderTarget> RenderTarget::create(int width, int height) {
    if (Status status = gl::checkImageSize("an image", width, height); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    RenderTarget target;
    target.width_ = width;
    target.height_ = height;
    const int half_width = (width + 1) / 2;
    const int half_height = (height + 1) / 2;
    target.color_ = gl::createImage(GL_RGBA8, width, height);
    target.normal_ = gl::createImage(GL_RGBA16_SNORM, width, height);
    target.surface_ = gl::createImage(GL_R32F, width, height);
    target.depth_ = gl::createImage(GL_R32F, width, height);
    target.ids_ = gl::createImage(GL_R16UI, width, height);
    target.z_buffer_ = gl::createImage(GL_DEPTH_COMPONENT32F, width, height);
    target.occlusion_ = gl::createImage(GL_RG32F, half_width, half_height);
    target.soft_occlusion_ = gl::createImage(GL_R8, half_width, half_height, true);
    target.lit_ = gl::createImage(GL_RGBA8, width, height, true);
    target.picture_ = gl::createImage(GL_RGBA8, width, height, true);

    target.surfaces_frame_ = gl::createFramebuffer();
    const unsigned frame = target.surfaces_frame_.get();
    const std::array<unsigned, 5> images = {target.color_.get(), target.normal_.get(),
                                            target.surface_.get(), target.depth_.get(),
                                            target.ids_.get()};
    std::array<GLenum, 5> outputs{};
    for (unsigned i = 0; i < images.size(); ++i) {
        outputs[i] = GL_COLOR_ATTACHMENT0 + i;
        glNamedFramebufferTexture(frame, outputs[i], images[i], 0);
    }
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, target.z_buffer_.get(), 0);
    glNamedFramebufferDrawBuffers(frame, outputs.size(), outputs.data());
    target.labels_frame_ = gl::createFramebuffer();
    const unsigned labels = target.labels_frame_.get();
    glNamedFramebufferTexture(labels, outputs[3], images[3], 0);
    glNamedFramebufferTexture(labels, outputs[4], images[4], 0);
    glNamedFramebufferTexture(labels, GL_DEPTH_ATTACHMENT, target.z_buffer_.get(), 0);
    target.shading_frame_ = gl::createFramebuffer();
    const unsigned shading = target.shading_frame_.get();
    for (unsigned i = 0; i < 3; ++i) glNamedFramebufferTexture(shading, outputs[i], images[i], 0);
    glNamedFramebufferTexture(shading, GL_DEPTH_ATTACHMENT, target.z_buffer_.get(), 0);
    glNamedFramebufferDrawBuffers(shading, 3, outputs.data());
    outputs[0] = outputs[1] = outputs[2] = GL_NONE;
    glNamedFramebufferDrawBuffers(labels, outputs.size(), outputs.data());
    target.occlusion_frame_ = frameOver(target.occlusion_);
    target.soft_frame_ = frameOver(target.soft_occlusion_);
    target.lit_frame_ = frameOver(target.lit_);
    target.picture_frame_ = frameOver(target.picture_);
    if (Status status = gl::checkErrors("creating the images"); !status) {
        return tl::unexpected(status.error());
    }
    if (glCheckNamedFramebufferStatus(frame, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return fail(ErrorCode::NoOpenGl,
                    "this OpenGL driver cannot render colour, depth and labels in one pass; use "
                    "Mesa's software driver");
    }
    return target;
}

void RenderTarget::makeSum() {
    if (sum_.get() != 0) return;
    sum_ = gl::createImage(GL_RGBA32F, width_, height_);
    sum_frame_ = frameOver(sum_);
    marks_ = gl::createImage(GL_DEPTH_COMPONENT32F, width_, height_);
    glNamedFramebufferTexture(sum_frame_.get(), GL_DEPTH_ATTACHMENT, marks_.get(), 0);
}

void RenderTarget::readRgb(std::vector<std::uint8_t>& rgb) const {
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    // Drivers copy 4-byte pixels fast and 3-byte pixels slowly.
    thread_local std::vector<std::uint8_t> rgba;
    rgba.resize(4 * pixels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(picture_.get(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(rgba.size()), rgba.data());
    rgb.resize(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        rgb[3 * i] = rgba[4 * i];
        rgb[3 * i + 1] = rgba[4 * i + 1];
        rgb[3 * i + 2] = rgba[4 * i + 2];
    }
}

void RenderTarget::readDepth(std::vector<float>& depth) const {
    readDrawnDepth(depth);
    for (float& value : depth) value = std::isfinite(value) ? std::abs(value) : 0.0F;
}

void RenderTarget::readDrawnDepth(std::vector<float>& depth) const {
    depth.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(depth_.get(), 0, GL_RED, GL_FLOAT,
                      static_cast<GLsizei>(depth.size() * sizeof(float)), depth.data());
}

void RenderTarget::readIds(std::vector<std::uint16_t>& ids) const {
    ids.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(ids_.get(), 0, GL_RED_INTEGER, GL_UNSIGNED_SHORT,
                      static_cast<GLsizei>(ids.size() * sizeof(std::uint16_t)), ids.data());
}

void RenderTarget::readLight(std::vector<float>& light) const {
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    thread_local std::vector<float> sums;
    sums.resize(4 * pixels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(sum_.get(), 0, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(sums.size() * sizeof(float)), sums.data());
    light.resize(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float weight = sums[4 * i + 3];
        const float scale = weight > 0.0F ? 1.0F / weight : 0.0F;
        for (std::size_t c = 0; c < 3; ++c) light[3 * i + c] = scale * sums[4 * i + c];
    }
}

RenderTarget::Pixel RenderTarget::readPixel(int x, int y) const {
    Pixel pixel;
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return pixel;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(depth_.get(), 0, x, y, 0, 1, 1, 1, GL_RED, GL_FLOAT, sizeof(pixel.depth_m),
                         &pixel.depth_m);
    pixel.depth_m = std::abs(pixel.depth_m);
    glGetTextureSubImage(ids_.get(), 0, x, y, 0, 1, 1, 1, GL_RED_INTEGER, GL_UNSIGNED_SHORT,
                         sizeof(pixel.object_id), &pixel.object_id);
    return pixel;
}

}  // namespace dollytrack::render
