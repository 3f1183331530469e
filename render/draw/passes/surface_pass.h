#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/glass_order.h"
#include "render/draw/passes/gpu_scene.h"
#include "render/draw/passes/multisample_buffer.h"
#include "render/draw/passes/occlusion_culling.h"
#include "render/draw/passes/render_target.h"
#include "render/draw/passes/surface_target.h"
#include "render/gl/handle.h"
#include "render/gl/program_variants.h"
#include "render/light/light_volume.h"
#include "render/view/view.h"

#include <GL/glew.h>

#include <vector>

namespace dollytrack::render {

/// Draws the surface buffer (G-buffer): colour, normal, depth and label at pixel centres. At equal
/// depth a later batch is on top, and within a batch the later object; all passes follow this
/// order, so that their images agree.
class SurfacePass {
  public:
    [[nodiscard]] static Result<SurfacePass> create();

    /// Sets the factors by which the light setting scales the emission of materials.
    void setLight(const LightVolume& light);
    /// Emission in the surface buffer is stored relative to this factor.
    [[nodiscard]] float shine() const;

    /// Links the shader variants that the scene and view need. Call it before the functions below.
    [[nodiscard]] Status prepare(const GpuScene& scene, const View& view);

    /// Draws everything that shading needs, and labels.
    void drawSurfaces(const GpuScene& scene, const View& view, RenderTarget& target);
    /// Draws everything that shading needs, without labels.
    void drawShading(const GpuScene& scene, const View& view, RenderTarget& target);
    /// Draws the multisampled surface buffer, without the objects that `culling` found hidden.
    void drawMultisampled(const GpuScene& scene, const View& view, OcclusionCulling& culling,
                          const MultisampleBuffer& images);
    /// Draws label depth and ids only. Starts the occlusion queries if `culling` is given.
    void drawLabels(const GpuScene& scene, const View& view, OcclusionCulling* culling,
                    RenderTarget& target);
    /// Draws label depth, ids, base colours (without light-dependent emission) and normals (without
    /// normal maps) of the labelled surfaces.
    void drawMaterials(const GpuScene& scene, const View& view, OcclusionCulling* culling,
                       SurfaceTarget& target);

  private:
    enum class Use { Picture, Materials };

    void drawOpaque(const GpuScene& scene, const View& view, const std::vector<bool>& visible,
                    Use use);
    /// Binds the texture and sets the factors of emission.
    void bindSurface(const Batch& batch, unsigned program, Use use) const;
    void tintByGlass(const GpuScene& scene, const View& view, const std::vector<bool>& visible);
    /// Draws the batch's visible pieces with one call.
    void drawShapes(const Batch& batch, const View& view, const std::vector<bool>& visible,
                    unsigned program);
    void drawCounted(const View& view, unsigned program) const;

    explicit SurfacePass(gl::Program glass);

    gl::ProgramVariants surface_;
    gl::ProgramVariants label_;
    gl::Program glass_;
    GlassOrder glass_order_;
    float lamps_shine_ = 1.0F;
    float outside_shines_ = 1.0F;
    std::vector<GLsizei> counts_;  // reused between frames
    std::vector<const void*> offsets_;
};

}  // namespace dollytrack::render
