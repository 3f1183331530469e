#pragma once

#include "engine/camera/camera_params.h"
#include "engine/geometry/ray_caster.h"
#include "render/draw/offscreen_renderer.h"
#include "render/gl/osmesa_context.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace dollytrack::render::fixture {

/// Gives a test its renderer, or skips it visibly where there is no OpenGL. With
/// DOLLYTRACK_REQUIRE_GL=1 that is a failure.
class GlTest : public testing::Test {
  protected:
    void SetUp() override {
        Result<std::unique_ptr<gl::Context>> context = gl::createOsMesaContext();
        if (context) {
            context_ = std::move(*context);
            return;
        }
        const char* required = std::getenv("DOLLYTRACK_REQUIRE_GL");
        if (required != nullptr && std::string_view(required) == "1") {
            FAIL() << describe(context.error());
        }
        GTEST_SKIP() << describe(context.error());
    }

    /// Without baked light unless asked: it costs time and most tests look at numbers.
    Result<OffscreenRenderer> makeRenderer(const Scene& scene, const CameraParams& camera,
                                           bool lit = false) {
        LightVolume light;
        light.cells = {1, 1, 1};
        light.ambient.assign(1, Eigen::Vector3f::Ones());
        light.lamps.assign(1, Eigen::Vector3f::Zero());
        if (lit) {
            const RayCaster rays(scene);
            LightVolumeParams params;
            params.max_cells = 3000;
            light = bakeLightVolume(scene, rays, makeLightRig(scene, rays), params);
        }
        return OffscreenRenderer::create(std::move(context_), scene, light, camera.width_px,
                                         camera.height_px);
    }

    std::unique_ptr<gl::Context> context_;
};

}  // namespace dollytrack::render::fixture
