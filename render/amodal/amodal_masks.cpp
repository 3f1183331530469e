#include "render/amodal/amodal_masks.h"

#include "render/draw/passes/view_uniforms.h"
#include "render/gl/context.h"
#include "render/gl/image.h"
#include "render/gl/shader.h"
#include "render/view/projected_box.h"

#include <GL/glew.h>

#include <algorithm>

namespace dollytrack::render {
namespace {

constexpr int kSide = 4096;  // of the texture, px; every OpenGL 4.5 driver supports more

/// Position of a mask on the texture.
struct Placed {
    int object_id = 0;
    PixelRect rect;  // in the image
    int x = 0;       // on the texture
    int y = 0;
};

/// Shelf packing in the given order; returns the first mask that no longer fits.
std::size_t arrange(std::vector<Placed>& masks, std::size_t first, int side, int& height) {
    int x = 0;
    int y = 0;
    int row = 0;
    std::size_t i = first;
    for (; i < masks.size(); ++i) {
        Placed& mask = masks[i];
        if (x + mask.rect.width() > side) {
            x = 0;
            y += row;
            row = 0;
        }
        if (y + mask.rect.height() > side) break;
        mask.x = x;
        mask.y = y;
        x += mask.rect.width();
        row = std::max(row, mask.rect.height());
    }
    height = y + row;
    return i;
}

}  // namespace

Result<AmodalMaskRenderer> AmodalMaskRenderer::create() {
    AmodalMaskRenderer drawer;
    Result<gl::Program> program = gl::linkProgram("silhouette.vert", "silhouette.frag");
    if (!program) return tl::unexpected(program.error());
    drawer.program_ = std::move(*program);
    return drawer;
}

Result<std::vector<RenderedAmodalMask>> AmodalMaskRenderer::draw(const GpuScene& scene,
                                                                 const View& view,
                                                                 std::span<const int> object_ids) {
    const PixelRect image{0, 0, view.intrinsics.width, view.intrinsics.height};
    std::vector<Placed> placed;
    for (const int id : object_ids) {
        const auto object = static_cast<std::size_t>(id) - 1;
        if (scene.bounds[object].isEmpty()) continue;
        const PixelRect rect = projectBox(scene.bounds[object], view, image);
        if (rect.width() > 0 && rect.height() > 0) placed.push_back({id, rect});
    }
    const int side = std::max({kSide, image.width(), image.height()});
    if (side != side_) {
        side_ = side;
        sheet_ = gl::createImage(GL_R8, side, side);
        frame_ = gl::createFramebuffer();
        glNamedFramebufferTexture(frame_.get(), GL_COLOR_ATTACHMENT0, sheet_.get(), 0);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.get());
    glUseProgram(program_.get());
    glBindVertexArray(scene.positions_layout.get());
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    std::vector<RenderedAmodalMask> masks;
    std::vector<std::uint8_t> sheet;
    for (std::size_t first = 0; first < placed.size();) {
        int height = 0;
        const std::size_t end = arrange(placed, first, side_, height);
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, side_, height);
        const std::array<float, 4> outside{};
        glClearBufferfv(GL_COLOR, 0, outside.data());
        for (std::size_t i = first; i < end; ++i) {
            const Placed& mask = placed[i];
            glViewport(mask.x, mask.y, mask.rect.width(), mask.rect.height());
            // A viewport clips triangles but not lines and points; the scissor does.
            glScissor(mask.x, mask.y, mask.rect.width(), mask.rect.height());
            setCamera(program_.get(), cutOut(view, mask.rect));
            const Piece& piece = scene.whole_objects[mask.object_id - 1];
            glDrawElements(
                GL_TRIANGLES, static_cast<GLsizei>(piece.index_count), GL_UNSIGNED_INT,
                reinterpret_cast<const void*>(  // NOLINT: OpenGL's offsets
                    static_cast<std::uintptr_t>(piece.first_index) * sizeof(std::uint32_t)));
        }
        glDisable(GL_SCISSOR_TEST);
        sheet.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(height));
        glGetTextureSubImage(sheet_.get(), 0, 0, 0, 0, side_, height, 1, GL_RED, GL_UNSIGNED_BYTE,
                             static_cast<GLsizei>(sheet.size()), sheet.data());
        for (std::size_t i = first; i < end; ++i) {
            const Placed& from = placed[i];
            RenderedAmodalMask mask{from.object_id,    from.rect.x0,       from.rect.y0,
                                    from.rect.width(), from.rect.height(), {}};
            for (int y = 0; y < mask.height; ++y) {
                const auto* row =
                    sheet.data() +
                    static_cast<std::size_t>(from.y + y) * static_cast<std::size_t>(side_) + from.x;
                mask.inside.insert(mask.inside.end(), row, row + mask.width);
            }
            masks.push_back(std::move(mask));
        }
        first = end;
    }
    if (Status status = gl::checkErrors("drawing whole objects"); !status) {
        return tl::unexpected(status.error());
    }
    return masks;
}

}  // namespace dollytrack::render
