#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/gpu_scene.h"
#include "render/gl/handle.h"
#include "render/light/light_rig.h"
#include "render/view/view.h"

namespace dollytrack::render {

/// Shadow map of the sun for drawn images; shadow casters are those of SunRays. The OpenGL
/// context in which it was created must be current for every call.
class SunShadow {
  public:
    [[nodiscard]] static Result<SunShadow> create(const SunLight& sun);

    /// Draws the shadow map. Call it again after objects moved.
    void draw(const GpuScene& scene);

    /// Changes the sun's brightness only.
    void setIrradiance(const Eigen::Vector3f& irradiance) { sun_.irradiance = irradiance; }

    /// Sets the uniforms and textures of light.frag.
    void use(unsigned program) const;

  private:
    SunLight sun_;
    View view_;  // from the sun; its image is the shadow map
    gl::Texture depth_;
    gl::Texture let_through_;
    gl::Framebuffer frame_;
    gl::Program program_;
};

}  // namespace dollytrack::render
