#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/light_sum.h"
#include "render/draw/passes/multisample_buffer.h"
#include "render/draw/passes/render_target.h"
#include "render/draw/passes/sun_shadow.h"
#include "render/gl/handle.h"
#include "render/gl/program_variants.h"
#include "render/light/light_volume.h"
#include "render/view/view.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dollytrack::render {

/// Shades the surface buffers: light volume, sun with shadow map, ambient occlusion, reflections.
class LightPass {
  public:
    LightPass();

    /// Uploads a light volume, replacing the current one.
    [[nodiscard]] Status setLight(const LightVolume& light);
    /// Changes strengths only: the volume keeps its grid, its lamp light and the sun's direction.
    void changeLight(const LightVolume& light);
    /// The sun's shadow map is drawn again before the next image.
    void forgetShadow() { sun_shadow_is_old_ = true; }

    /// Smooth surfaces show these reflections from now on.
    /// @param image  the result of TracedReflections::trace() for rows first_row to last_row of the
    ///     view
    void setReflections(const std::vector<Eigen::Vector4f>& image, const View& view, int first_row,
                        int last_row);
    /// Smooth surfaces show the light volume's blurred ambient light instead of traced reflections.
    void blurReflections() { reflects_ = false; }

    /// Links the shader variants and updates the sun's shadow map. Call it before the functions
    /// below.
    [[nodiscard]] Status prepare(const GpuScene& scene);

    /// Screen-space ambient occlusion (SSAO) of the surfaces in the target, at half resolution.
    void drawOcclusion(const GpuScene& scene, const View& view, RenderTarget& target);
    /// The same for the first sample of a multisampled surface buffer.
    void drawOcclusion(const GpuScene& scene, const View& view, const MultisampleBuffer& samples,
                       RenderTarget& target);
    /// Instead of drawOcclusion(): nothing is occluded.
    void skipOcclusion(RenderTarget& target);

    /// Shades the target's surface buffer. `shine` is SurfacePass::shine().
    void drawPicture(const View& view, float shine, RenderTarget& target);
    /// Adds a multisampled surface buffer to the target's sum, each sample with weight `share`.
    /// Pixels whose samples agree are shaded once.
    void addSamples(const View& view, float shine, float share, const MultisampleBuffer& samples,
                    RenderTarget& target);
    /// Adds the target's surface buffer as linear light before the tone curve; see LightSum.
    void addLight(const View& view, float shine, const LightSum& sum, RenderTarget& target);

    /// Encodes the sum as the finished image.
    void encodeSum(RenderTarget& target);
    /// Antialiases the result of drawPicture() with an edge filter; this makes the finished
    /// image.
    void smoothEdges(RenderTarget& target);

  private:
    void keep(const LightVolume& light);
    void drawOcclusion(const View& view, unsigned program, RenderTarget& target);
    [[nodiscard]] unsigned everyKind() const;
    [[nodiscard]] unsigned lightProgram(unsigned kind) const;
    void setLightOf(const View& view, float shine, unsigned program, RenderTarget& target);
    void draw(const gl::Framebuffer& frame, int width, int height, unsigned program) const;
    void drawSum(RenderTarget& target, unsigned program);

    LightVolume light_;  // without the grid values, which are on the graphics card
    gl::Texture ambient_;
    gl::Texture slope_;
    gl::Texture lamps_;
    gl::Texture reflections_;
    int reflections_width_ = 0;
    int reflections_height_ = 0;
    bool reflects_ = false;
    gl::Texture sky_;  // indexed by the sine of a direction's elevation
    gl::VertexArray no_vertices_;
    gl::ProgramVariants lighting_;
    gl::ProgramVariants occlusion_;
    gl::ProgramVariants soften_;
    gl::ProgramVariants edges_;
    gl::ProgramVariants encode_;
    std::optional<SunShadow> sun_shadow_;  // only if the volume has a sun
    bool sun_shadow_is_old_ = true;
};

}  // namespace dollytrack::render
