#include "render/draw/passes/surface_target.h"

#include "render/draw/passes/render_target.h"
#include "render/gl/context.h"
#include "render/gl/image.h"

#include <GL/glew.h>

#include <array>
#include <cmath>

namespace dollytrack::render {
namespace {

/// Converts the square root of linear albedo to sRGB.
std::array<std::uint8_t, 256> makeSrgbTable() {
    std::array<std::uint8_t, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double root = static_cast<double>(i) / 255.0;
        const double linear = root * root;
        const double srgb =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
        table[i] = static_cast<std::uint8_t>(std::lround(255.0 * srgb));
    }
    return table;
}

}  // namespace

Result<SurfaceTarget> SurfaceTarget::create(const RenderTarget& labels) {
    SurfaceTarget target;
    const int width = target.width_ = labels.width();
    const int height = target.height_ = labels.height();
    target.color_ = gl::createImage(GL_RGBA8, width, height);
    target.normal_ = gl::createImage(GL_RGBA16_SNORM, width, height);
    target.z_buffer_ = gl::createImage(GL_DEPTH_COMPONENT32F, width, height);
    target.frame_ = gl::createFramebuffer();
    const unsigned frame = target.frame_.get();
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, target.color_.get(), 0);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT1, target.normal_.get(), 0);
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, target.z_buffer_.get(), 0);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT3, labels.depth_.get(), 0);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT4, labels.ids_.get(), 0);
    // The depth of shaded surfaces (attachment 2) is not drawn.
    const std::array<GLenum, 5> outputs = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_NONE,
                                           GL_COLOR_ATTACHMENT3, GL_COLOR_ATTACHMENT4};
    glNamedFramebufferDrawBuffers(frame, outputs.size(), outputs.data());
    if (Status status = gl::checkErrors("creating the images of surfaces"); !status) {
        return tl::unexpected(status.error());
    }
    return target;
}

void SurfaceTarget::readNormals(std::vector<Eigen::Vector3f>& normals) const {
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    thread_local std::vector<std::int16_t> values;
    values.resize(4 * pixels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(normal_.get(), 0, GL_RGBA, GL_SHORT, static_cast<GLsizei>(8 * pixels),
                      values.data());
    normals.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        normals[i] = Eigen::Vector3f(values[4 * i], values[4 * i + 1], values[4 * i + 2]) / 32767.F;
    }
}

void SurfaceTarget::readAlbedo(std::vector<std::uint8_t>& albedo) const {
    static const std::array<std::uint8_t, 256> kSrgb = makeSrgbTable();
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    thread_local std::vector<std::uint8_t> rgba;
    rgba.resize(4 * pixels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(color_.get(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(4 * pixels),
                      rgba.data());
    albedo.resize(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t c = 0; c < 3; ++c) albedo[3 * i + c] = kSrgb[rgba[4 * i + c]];
    }
}

}  // namespace dollytrack::render
