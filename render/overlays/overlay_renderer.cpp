#include "render/overlays/overlay_renderer.h"

#include "render/draw/passes/view_uniforms.h"
#include "render/gl/context.h"
#include "render/gl/shader.h"

#include <GL/glew.h>

#include <array>
#include <tuple>

namespace dollytrack::render {
namespace {

// Draws lines on a surface in front of it; as in overlay_painter.cpp.
constexpr float kDepthBias = 0.01F;              // relative to depth
constexpr float kOrthographicDepthBias = 0.02F;  // m

constexpr int kClipPlanes = 6;  // of overlay_surface.vert
constexpr int kClipLow = 8;     // uniforms of all vertex shaders
constexpr int kClipHigh = 9;

float biasOf(const View& view) {
    return view.orthographic ? kOrthographicDepthBias : kDepthBias;
}

}  // namespace

Result<OverlayRenderer> OverlayRenderer::create() {
    OverlayRenderer renderer;
    const std::array<std::tuple<gl::Program*, const char*, const char*>, 4> programs = {{
        {&renderer.surfaces_, "overlay_surface.vert", "overlay_surface.frag"},
        {&renderer.blend_, "picture.vert", "overlay_blend.frag"},
        {&renderer.lines_, "overlay_line.vert", "overlay_line.frag"},
        {&renderer.marks_, "overlay_mark.vert", "overlay_mark.frag"},
    }};
    for (const auto& [program, vertex, fragment] : programs) {
        Result<gl::Program> linked = gl::linkProgram(vertex, fragment);
        if (!linked) return tl::unexpected(linked.error());
        *program = std::move(*linked);
    }
    renderer.no_vertices_ = gl::createVertexArray();
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    if (Status status = gl::checkErrors("preparing to draw overlays"); !status) {
        return tl::unexpected(status.error());
    }
    return renderer;
}

Status OverlayRenderer::draw(std::span<const OverlayLayer> layers, const View& view,
                             const RenderTarget& target, OverlayCanvas& canvas,
                             double pixel_scale) {
    if (canvas.width() != target.width() || canvas.height() != target.height()) {
        return fail(ErrorCode::Failed, "the overlays' canvas must have the image's size");
    }
    glCopyImageSubData(target.picture(), GL_TEXTURE_2D, 0, 0, 0, 0, canvas.picture_.get(),
                       GL_TEXTURE_2D, 0, 0, 0, 0, canvas.width(), canvas.height(), 1);
    glViewport(0, 0, canvas.width(), canvas.height());
    glDisable(GL_SCISSOR_TEST);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);
    for (const OverlayLayer& layer : layers) {
        if (layer.buffers->box_indices_ + layer.buffers->triangle_indices_ == 0) continue;
        glBindTextureUnit(0, target.depth());
        drawSurfaces(layer, view, canvas);
    }
    // Two depth-tested passes against the scene's depth buffer, one for visible and one for hidden
    // parts. This is far cheaper than reading the depth in every fragment.
    const unsigned frame = canvas.frame_.get();
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, target.zBuffer(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glEnable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    for (const OverlayLayer& layer : layers) {
        const OverlayBuffers& buffers = *layer.buffers;
        drawSigns(lines_, buffers.strokes_, buffers.line_count_, layer, view, pixel_scale);
        drawSigns(marks_, buffers.marks_, buffers.mark_count_, layer, view, pixel_scale);
    }
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, 0, 0);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return gl::checkErrors("drawing overlays");
}

void OverlayRenderer::drawSurfaces(const OverlayLayer& layer, const View& view,
                                   OverlayCanvas& canvas) {
    // Drawn into a separate image with its own depth buffer, then blended over the image: the
    // order of boxes does not matter, and each pixel is tinted once.
    glBindFramebuffer(GL_FRAMEBUFFER, canvas.surface_frame_.get());
    const std::array<float, 4> zero{};
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glClearBufferfv(GL_DEPTH, 0, zero.data());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glUseProgram(surfaces_.get());
    setCamera(surfaces_.get(), view);
    glProgramUniform2f(surfaces_.get(), 4, layer.opacity, layer.opacity * layer.hidden_opacity);
    glProgramUniform1f(surfaces_.get(), 5, biasOf(view));
    setClipBox(surfaces_.get(), kClipLow, kClipHigh, view);
    for (int i = 0; view.clip_box && i < kClipPlanes; ++i) glEnable(GL_CLIP_DISTANCE0 + i);
    const OverlayBuffers& buffers = *layer.buffers;
    glBindVertexArray(buffers.surfaces_.layout.get());
    // Row 0 is the top, so counter-clockwise faces appear clockwise.
    glFrontFace(GL_CW);
    glEnable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, buffers.box_indices_, GL_UNSIGNED_INT, nullptr);
    if (!buffers.one_sided_triangles_) glDisable(GL_CULL_FACE);
    if (buffers.triangle_indices_ > 0) {
        glDrawElements(
            GL_TRIANGLES, buffers.triangle_indices_, GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(  // NOLINT: OpenGL's offsets
                static_cast<std::uintptr_t>(buffers.box_indices_) * sizeof(std::uint32_t)));
    }
    for (int i = 0; i < kClipPlanes; ++i) glDisable(GL_CLIP_DISTANCE0 + i);
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glDisable(GL_DEPTH_TEST);

    glBindFramebuffer(GL_FRAMEBUFFER, canvas.frame_.get());
    glBindTextureUnit(0, canvas.surface_color_.get());
    glBindVertexArray(no_vertices_.get());
    glEnable(GL_BLEND);
    glUseProgram(blend_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
}

void OverlayRenderer::drawSigns(const gl::Program& program, const OverlayBuffers::Part& part,
                                int count, const OverlayLayer& layer, const View& view,
                                double pixel_scale) {
    if (count == 0) return;
    glUseProgram(program.get());
    setCamera(program.get(), view);
    glProgramUniform2f(program.get(), 4, static_cast<float>(view.intrinsics.width),
                       static_cast<float>(view.intrinsics.height));
    glProgramUniform1f(program.get(), 5, static_cast<float>(pixel_scale));
    glProgramUniform1f(program.get(), 7, biasOf(view));
    setClipBox(program.get(), kClipLow, kClipHigh, view);
    glBindVertexArray(part.layout.get());
    if (layer.hidden_opacity > 0.0F) {
        glDepthFunc(GL_LESS);
        glProgramUniform1f(program.get(), 6, layer.opacity * layer.hidden_opacity);
        glDrawElements(GL_TRIANGLES, 6 * count, GL_UNSIGNED_INT, nullptr);
    }
    glDepthFunc(GL_GEQUAL);
    glProgramUniform1f(program.get(), 6, layer.opacity);
    glDrawElements(GL_TRIANGLES, 6 * count, GL_UNSIGNED_INT, nullptr);
}

}  // namespace dollytrack::render
