#pragma once

#include "engine/core/result.h"
#include "render/draw/look_images.h"
#include "render/draw/render_target.h"
#include "render/draw/view.h"
#include "render/gl/handle.h"
#include "render/gl/program_variants.h"
#include "render/light/light_sum.h"
#include "render/light/light_volume.h"
#include "render/light/sun_shadow.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dollytrack::render {

/// Lights surface buffers by what a light volume knows, the sun's shadow, and what stands near.
class LightPass {
  public:
    LightPass();

    /// Other light from now on.
    [[nodiscard]] Status setLight(const LightVolume& light);
    /// The same light in other strengths: the sun stays where it is, and so do the lamps.
    void changeLight(const LightVolume& light);
    /// The sun's shadow is no longer that of the scene.
    void forgetShadow() { sun_shadow_is_old_ = true; }

    /// What smooth surfaces of the next pictures show, as TracedReflections::trace() has these rows
    /// of the view's image.
    void setReflections(const std::vector<Eigen::Vector4f>& image, const View& view, int first_row,
                        int last_row);
    /// They show the room's blurred light.
    void blurReflections() { reflects_ = false; }

    /// Links what may be needed and draws the sun's shadow where it is old; before any of the
    /// following.
    [[nodiscard]] Status prepare(const GpuScene& scene);

    /// What of the light around reaches corners, of the surfaces in the target.
    void drawOcclusion(const GpuScene& scene, const View& view, RenderTarget& target);
    /// The same of the surfaces that the first of several looks sees.
    void drawOcclusion(const GpuScene& scene, const View& view, const LookImages& looks,
                       RenderTarget& target);

    // The surfaces in the target lit; `shine` is what emission in it is a share of.
    void drawPicture(const View& view, float shine, RenderTarget& target);
    /// What several looks see, added to the target's sum, each with this share of it. Where all see
    /// the same, it is lit once.
    void addLooks(const View& view, float shine, float share, const LookImages& looks,
                  RenderTarget& target);
    /// Added to it as light before the tone curve, see LightSum.
    void addLight(const View& view, float shine, const LightSum& sum, RenderTarget& target);

    /// The sum as a picture.
    void encodeSum(RenderTarget& target);
    /// The picture of drawPicture() with smooth edges.
    void smoothEdges(RenderTarget& target);

  private:
    void keep(const LightVolume& light);
    void drawOcclusion(const View& view, unsigned program, RenderTarget& target);
    [[nodiscard]] unsigned everyKind() const;
    [[nodiscard]] unsigned lightProgram(unsigned kind) const;
    void setLightOf(const View& view, float shine, unsigned program, RenderTarget& target);
    void draw(const gl::Framebuffer& frame, int width, int height, unsigned program) const;
    void drawSum(RenderTarget& target, unsigned program);

    LightVolume light_;  // without its cells
    gl::Texture ambient_;
    gl::Texture slope_;
    gl::Texture lamps_;
    gl::Texture reflections_;
    int reflections_width_ = 0;
    int reflections_height_ = 0;
    bool reflects_ = false;
    gl::Texture sky_;  // by the sine of a way's height
    gl::VertexArray no_vertices_;
    gl::ProgramVariants lighting_;
    gl::ProgramVariants occlusion_;
    gl::ProgramVariants soften_;
    gl::ProgramVariants edges_;
    gl::ProgramVariants encode_;
    std::optional<SunShadow> sun_shadow_;  // where there is a sun
    bool sun_shadow_is_old_ = true;
};

}  // namespace dollytrack::render
