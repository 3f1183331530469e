#pragma once

#include "engine/camera/lens_model.h"
#include "engine/camera/picture_params.h"
#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "render/draw/passes/render_target.h"
#include "render/draw/scene_renderer.h"
#include "render/view/view.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <map>
#include <vector>

namespace dollytrack::render {

/// Draws colour images of any lens. Pinhole and orthographic lenses are drawn directly. Wide lenses
/// are resampled from square pinhole images around the same centre, at the lens's finest
/// resolution: from one image if that covers the lens, else from the sides of a cube, which overlap
/// and blend into each other. The top and bottom sides of a panorama have twice the resolution,
/// because its rows are stretched around the poles. The renderer's OpenGL context must be current.
class LensPictures {
  public:
    /// `look` sets antialiasing and reflections. `sides_from_camera` rotates the cube; only tests
    /// use it.
    LensPictures(double near_m, const PictureParams& look,
                 const Eigen::Quaterniond& sides_from_camera = Eigen::Quaterniond::Identity());

    /// Allocates the render targets for draw(). Returns Usage if an image exceeds the driver's
    /// limit, Failed if the graphics memory does not suffice.
    [[nodiscard]] Status prepare(const LensModel& lens);

    /// Draws an sRGB image, 3 bytes per pixel; black outside the lens's image circle. `rays` must
    /// cast against the scene as the renderer shows it.
    [[nodiscard]] Status draw(const LensModel& lens, const Pose& pose, SceneRenderer& renderer,
                              const RayCaster& rays, std::vector<std::uint8_t>& rgb);

    /// One pinhole image from which a wide lens is resampled.
    struct Side {
        Eigen::Quaterniond camera_from_side = Eigen::Quaterniond::Identity();
        double reach = 1.0;  // tangent of the angle from its axis to its border
        int size_px = 0;
        bool alone = false;  // the only image, so nothing to blend with
        bool finer = false;  // has twice the lens's resolution
    };
    /// The pinhole images that cover the lens; those that contribute nothing are left out.
    [[nodiscard]] std::vector<Side> sidesFor(const LensModel& lens) const;

  private:
    [[nodiscard]] Result<RenderTarget*> targetOf(int width, int height);
    [[nodiscard]] Status drawView(const View& view, SceneRenderer& renderer, const RayCaster& rays,
                                  std::vector<std::uint8_t>& rgb);

    double near_m_;
    PictureParams look_;
    Eigen::Quaterniond sides_from_camera_;
    std::map<std::pair<int, int>, RenderTarget> targets_;  // by width and height
};

/// The view of a pinhole or orthographic lens.
[[nodiscard]] View viewThrough(const LensModel& lens, const Pose& pose, double near_m);

}  // namespace dollytrack::render
