#include "render/overlays/overlay_canvas.h"

#include "render/gl/context.h"
#include "render/gl/image.h"

#include <GL/glew.h>

#include <utility>

namespace dollytrack::render {
Result<OverlayCanvas> OverlayCanvas::create(int width, int height) {
    if (Status status = gl::checkImageSize("overlays", width, height); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    OverlayCanvas canvas;
    canvas.width_ = width;
    canvas.height_ = height;
    canvas.picture_ = gl::createImage(GL_RGBA8, width, height, true);
    canvas.frame_ = gl::createFramebuffer();
    glNamedFramebufferTexture(canvas.frame_.get(), GL_COLOR_ATTACHMENT0, canvas.picture_.get(), 0);
    canvas.surface_color_ = gl::createImage(GL_RGBA8, width, height, true);
    canvas.surface_z_ = gl::createImage(GL_DEPTH_COMPONENT32F, width, height, true);
    canvas.surface_frame_ = gl::createFramebuffer();
    const unsigned frame = canvas.surface_frame_.get();
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, canvas.surface_color_.get(), 0);
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, canvas.surface_z_.get(), 0);
    if (Status status = gl::checkErrors("creating the overlays' images"); !status) {
        return tl::unexpected(status.error());
    }
    return canvas;
}

void OverlayCanvas::readRgba(std::vector<std::uint8_t>& rgba) const {
    rgba.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(picture_.get(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(rgba.size()), rgba.data());
}

void OverlayCanvas::readRgb(std::vector<std::uint8_t>& rgb) const {
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    rgb.resize(3 * pixels);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(picture_.get(), 0, GL_RGB, GL_UNSIGNED_BYTE, static_cast<GLsizei>(rgb.size()),
                      rgb.data());
}

}  // namespace dollytrack::render
