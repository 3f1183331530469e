#pragma once

#include "engine/core/result.h"
#include "render/draw/gpu_scene.h"
#include "render/draw/view.h"
#include "render/gl/handle.h"
#include "render/light/light_rig.h"

namespace dollytrack::render {

/// Where the sun's light falls in a drawn scene: what the sun sees of it, as SunRays says what
/// stands in its way. Needs the OpenGL context current that it was created in.
class SunShadow {
  public:
    [[nodiscard]] static Result<SunShadow> create(const SunLight& sun);

    /// Draws what the sun sees; again when things have moved.
    void draw(const GpuScene& scene);

    /// The same sun, as bright as this.
    void setIrradiance(const Eigen::Vector3f& irradiance) { sun_.irradiance = irradiance; }

    /// Sets the uniforms and textures of light.frag.
    void use(unsigned program) const;

  private:
    SunLight sun_;
    View view_;  // from the sun; its image is the map
    gl::Texture depth_;
    gl::Texture let_through_;
    gl::Framebuffer frame_;
    gl::Program program_;
};

}  // namespace dollytrack::render
