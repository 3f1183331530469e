#pragma once

#include "engine/core/result.h"
#include "render/draw/glass_order.h"
#include "render/draw/gpu_scene.h"
#include "render/draw/look_images.h"
#include "render/draw/occlusion_culling.h"
#include "render/draw/render_target.h"
#include "render/draw/surface_target.h"
#include "render/draw/view.h"
#include "render/gl/handle.h"
#include "render/gl/program_variants.h"
#include "render/light/light_volume.h"

#include <GL/glew.h>

#include <vector>

namespace dollytrack::render {

/// Draws a scene's surfaces into the images that later passes light: what a pixel's middle sees of
/// colours, normals, depths and labels. Of two surfaces at one depth the later batch's is on top,
/// and of one batch the later object's; that holds in every pass, so that their images agree.
class SurfacePass {
  public:
    [[nodiscard]] static Result<SurfacePass> create();

    /// What the light makes of emission.
    void setLight(const LightVolume& light);
    /// What emission in the surface buffer is a share of.
    [[nodiscard]] float shine() const;

    /// Links what a view of the scene needs; before any of the following.
    [[nodiscard]] Status prepare(const GpuScene& scene, const View& view);

    /// Everything that lighting needs to know, and labels.
    void drawSurfaces(const GpuScene& scene, const View& view, RenderTarget& target);
    /// The same without labels: the look of a picture that has one, or of a sum.
    void drawLook(const GpuScene& scene, const View& view, RenderTarget& target);
    /// Several looks at once, without what the labels of the view have hidden.
    void drawLooks(const GpuScene& scene, const View& view, OcclusionCulling& culling,
                   const LookImages& images);
    /// What drawSurfaces puts into the images of labels alone; starts the culling, if any.
    void drawLabels(const GpuScene& scene, const View& view, OcclusionCulling* culling,
                    RenderTarget& target);
    /// The same and, of what is labelled, colours without the light's changes and normals without
    /// maps.
    void drawMaterials(const GpuScene& scene, const View& view, OcclusionCulling* culling,
                       SurfaceTarget& target);

  private:
    enum class Use { Picture, Materials };

    void drawOpaque(const GpuScene& scene, const View& view, const std::vector<bool>& visible,
                    Use use);
    /// The texture, and what the light does to what shines by itself.
    void bindSurface(const Batch& batch, unsigned program, Use use) const;
    void tintByGlass(const GpuScene& scene, const View& view, const std::vector<bool>& visible);
    /// Whose places in the index buffer are counted out for one call.
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
    std::vector<GLsizei> counts_;  // kept between frames
    std::vector<const void*> offsets_;
};

}  // namespace dollytrack::render
