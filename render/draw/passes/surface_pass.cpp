#include "render/draw/passes/surface_pass.h"

#include "render/draw/passes/view_uniforms.h"
#include "render/gl/shader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace dollytrack::render {
namespace {

// Macros of surface.frag. label.frag knows kCut only.
constexpr unsigned kCut = 1;
constexpr unsigned kTextured = 2;
constexpr unsigned kHoles = 4;
constexpr unsigned kMaps = 8;

unsigned wordsOf(const View& view) {
    return view.structure_cut || view.clip_box ? kCut : 0U;
}

/// @param picture  macros for the colour image (with maps), or for the bare material
unsigned wordsOf(const Batch& batch, bool picture) {
    unsigned words = 0;
    if (batch.texture != 0) words |= kTextured;
    if (batch.texture != 0 && batch.surface == Surface::CutOut) words |= kHoles;
    if (picture && batch.maps) words |= kMaps;
    return words;
}

const void* offsetOf(std::uint32_t index) {
    return reinterpret_cast<const void*>(  // NOLINT: OpenGL's offsets
        static_cast<std::uintptr_t>(index) * sizeof(std::uint32_t));
}

constexpr int kIds = 4;  // image of ids, which holds integers; the others hold floats

/// Binds the frame and clears its depth and these images. Depth is reversed: 0 is far.
void begin(const GpuScene& scene, const gl::Framebuffer& frame, int width, int height,
           std::initializer_list<int> images) {
    glBindFramebuffer(GL_FRAMEBUFFER, frame.get());
    glViewport(0, 0, width, height);
    const std::array<float, 4> zero{};
    const std::array<unsigned, 4> no_id{};
    for (const int image : images) {
        if (image == kIds) {
            glClearBufferuiv(GL_COLOR, image, no_id.data());
        } else {
            glClearBufferfv(GL_COLOR, image, zero.data());
        }
    }
    glClearBufferfv(GL_DEPTH, 0, zero.data());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glBindVertexArray(scene.layout.get());
}

void bindMaps(const BatchMaps& maps, unsigned program) {
    const std::array<unsigned, 4> textures = {maps.normal, maps.roughness, maps.metallic,
                                              maps.emission};
    std::array<GLint, 4> there{};
    for (unsigned i = 0; i < textures.size(); ++i) {
        there[i] = textures[i] != 0 ? 1 : 0;
        if (textures[i] != 0) glBindTextureUnit(9 + i, textures[i]);
    }
    glProgramUniform4iv(program, 10, 1, there.data());
    glProgramUniform1f(program, 11, maps.normal_scale);
    glProgramUniform3fv(program, 12, 1, maps.emission_factor.data());
}

void bindGlass(const Batch& batch, unsigned program, float tint) {
    glProgramUniform1i(program, 4, batch.texture != 0 ? 1 : 0);
    glProgramUniform1f(program, 5, tint);
    if (batch.texture != 0) glBindTextureUnit(0, batch.texture);
}

}  // namespace

SurfacePass::SurfacePass(gl::Program glass)
    : surface_("surface.vert", "surface.frag", {"CUT", "TEXTURED", "HOLES", "MAPS"}),
      label_("surface.vert", "label.frag", {"CUT"}),
      glass_(std::move(glass)) {}

Result<SurfacePass> SurfacePass::create() {
    Result<gl::Program> glass = gl::linkProgram("surface.vert", "glass.frag");
    if (!glass) return tl::unexpected(glass.error());
    return SurfacePass(std::move(*glass));
}

void SurfacePass::setLight(const LightVolume& light) {
    lamps_shine_ = light.lamps_shine;
    outside_shines_ = light.outside_shines;
}

float SurfacePass::shine() const {
    return std::max({lamps_shine_, outside_shines_, 1.0F});
}

Status SurfacePass::prepare(const GpuScene& scene, const View& view) {
    if (Status status = label_.link(wordsOf(view)); !status) return status;
    for (const Batch& batch : scene.batches) {
        const unsigned material = wordsOf(batch, false);
        for (const unsigned words : {wordsOf(batch, true), material, material & ~kHoles}) {
            if (Status status = surface_.link(wordsOf(view) | words); !status) return status;
        }
    }
    return {};
}

void SurfacePass::drawSurfaces(const GpuScene& scene, const View& view, RenderTarget& target) {
    begin(scene, target.surfaces_frame_, target.width(), target.height(), {0, 1, 2, 3, kIds});
    const std::vector<bool> visible = objectsInView(scene, view);
    drawOpaque(scene, view, visible, Use::Picture);
    tintByGlass(scene, view, visible);
    // Glass and holes write label depth and id only.
    for (unsigned i = 0; i < 3; ++i) glColorMaski(i, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const Batch& batch : scene.batches) {
        if (batch.surface == Surface::Opaque) continue;
        bindGlass(batch, glass_.get(), 0.0F);
        drawShapes(batch, view, visible, glass_.get());
    }
    for (unsigned i = 0; i < 3; ++i) glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

void SurfacePass::drawShading(const GpuScene& scene, const View& view, RenderTarget& target) {
    begin(scene, target.shading_frame_, target.width(), target.height(), {0, 1, 2});
    const std::vector<bool> visible = objectsInView(scene, view);
    drawOpaque(scene, view, visible, Use::Picture);
    tintByGlass(scene, view, visible);
    glDisable(GL_DEPTH_TEST);
}

void SurfacePass::drawMultisampled(const GpuScene& scene, const View& view,
                                   OcclusionCulling& culling, const MultisampleBuffer& images) {
    begin(scene, images.frame_, view.intrinsics.width, view.intrinsics.height, {0, 1});
    glMinSampleShading(1.0F);
    std::vector<bool> visible = objectsInView(scene, view);
    culling.takeHidden(visible);
    drawOpaque(scene, view, visible, Use::Picture);
    tintByGlass(scene, view, visible);
    glDisable(GL_DEPTH_TEST);
}

/// Glass in front of the nearest non-glass surface tints the colour behind it.
void SurfacePass::tintByGlass(const GpuScene& scene, const View& view,
                              const std::vector<bool>& visible) {
    if (scene.glass.empty()) return;
    for (unsigned i = 1; i < 5; ++i) glColorMaski(i, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
    glEnablei(GL_BLEND, 0);
    glBlendFunci(0, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    glass_order_.visit(scene, view, visible,
                       [&](const Batch& batch, std::uint32_t first, std::uint32_t count) {
                           counts_ = {static_cast<GLsizei>(count)};
                           offsets_ = {offsetOf(first)};
                           bindGlass(batch, glass_.get(), 1.0F);
                           drawCounted(view, glass_.get());
                       });
    glDepthMask(GL_TRUE);
    glDisablei(GL_BLEND, 0);
    for (unsigned i = 0; i < 5; ++i) glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void SurfacePass::drawLabels(const GpuScene& scene, const View& view, OcclusionCulling* culling,
                             RenderTarget& target) {
    begin(scene, target.labels_frame_, target.width(), target.height(), {3, kIds});
    const std::vector<bool> visible = objectsInView(scene, view);
    // Glass and cut-outs are drawn last, as in drawSurfaces().
    for (const bool opaque : {true, false}) {
        for (const Batch& batch : scene.batches) {
            if ((batch.surface == Surface::Opaque) != opaque) continue;
            drawShapes(batch, view, visible, label_.get(wordsOf(view)));
        }
        if (opaque && culling != nullptr) culling->start(scene, view, visible);
    }
    glDisable(GL_DEPTH_TEST);
}

void SurfacePass::drawMaterials(const GpuScene& scene, const View& view, OcclusionCulling* culling,
                                SurfaceTarget& target) {
    begin(scene, target.frame_, target.width(), target.height(), {0, 1, 3, kIds});
    const std::vector<bool> visible = objectsInView(scene, view);
    drawOpaque(scene, view, visible, Use::Materials);
    if (culling != nullptr) culling->start(scene, view, visible);
    for (const Batch& batch : scene.batches) {
        if (batch.surface == Surface::Opaque) continue;
        const unsigned program = surface_.get(wordsOf(view) | (wordsOf(batch, false) & ~kHoles));
        bindSurface(batch, program, Use::Materials);
        drawShapes(batch, view, visible, program);
    }
    glDisable(GL_DEPTH_TEST);
}

/// Draws opaque surfaces and cut-outs, the latter with their holes.
void SurfacePass::drawOpaque(const GpuScene& scene, const View& view,
                             const std::vector<bool>& visible, Use use) {
    const bool picture = use == Use::Picture;
    for (const Batch& batch : scene.batches) {
        if (batch.surface == Surface::Glass) continue;
        const unsigned program = surface_.get(wordsOf(view) | wordsOf(batch, picture));
        bindSurface(batch, program, use);
        // Cut-outs are shaded per sample, because the edges of holes run through pixels.
        if (batch.surface == Surface::CutOut) glEnable(GL_SAMPLE_SHADING);
        if (picture && batch.maps) bindMaps(*batch.maps, program);
        drawShapes(batch, view, visible, program);
        glDisable(GL_SAMPLE_SHADING);
    }
}

void SurfacePass::bindSurface(const Batch& batch, unsigned program, Use use) const {
    const bool picture = use == Use::Picture;
    glProgramUniform2f(program, 13, picture ? lamps_shine_ / shine() : 1.0F,
                       picture ? std::max(outside_shines_, 1.0F) / shine() : 1.0F);
    glProgramUniform1f(program, 14, picture ? std::sqrt(std::min(outside_shines_, 1.0F)) : 1.0F);
    if (batch.texture != 0) glBindTextureUnit(0, batch.texture);
}

void SurfacePass::drawShapes(const Batch& batch, const View& view, const std::vector<bool>& visible,
                             unsigned program) {
    counts_.clear();
    offsets_.clear();
    for (const Piece& piece : batch.pieces) {
        if (!visible[piece.object_id - 1]) continue;
        const auto count = view.coarse ? piece.coarse_count : piece.index_count;
        counts_.push_back(static_cast<GLsizei>(count));
        offsets_.push_back(offsetOf(view.coarse ? piece.coarse_first : piece.first_index));
    }
    if (!counts_.empty()) drawCounted(view, program);
}

void SurfacePass::drawCounted(const View& view, unsigned program) const {
    glUseProgram(program);
    setCamera(program, view);
    const StructureCut structure_cut = view.structure_cut.value_or(StructureCut{});
    const Eigen::Vector4f cut = structure_cut.plane.cast<float>();
    glProgramUniform1f(program, 8, static_cast<float>(structure_cut.keep_below_z));
    glProgramUniform1f(program, 9, static_cast<float>(structure_cut.ceiling_z));
    glProgramUniform4fv(program, 6, 1, cut.data());
    setClipBox(program, 15, 16, view);
    const Eigen::Vector3f eye = view.pose.position.cast<float>();
    glProgramUniform3fv(program, 7, 1, eye.data());
    glMultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                        static_cast<GLsizei>(counts_.size()));
}

}  // namespace dollytrack::render
