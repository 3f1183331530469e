#pragma once

#include "engine/camera/lens_model.h"
#include "engine/camera/picture_params.h"
#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "render/draw/render_target.h"
#include "render/draw/scene_renderer.h"
#include "render/draw/view.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <map>
#include <vector>

namespace dollytrack::render {

/// Draws the pictures of any lens. Pinholes and parallel rays are drawn as they are. Wide lenses
/// are put together from square pinhole pictures around the same centre, as fine as the lens is at
/// its finest: one where that will do, else the sides of a cube that reach over their edges and
/// fade into each other there. Those with a panorama's poles, around which its rows are stretched,
/// are twice as fine. Needs the renderer's OpenGL context current.
class LensPictures {
  public:
    /// `look` is that of the drawn pictures. `sides_from_camera` turns the cube: only tests need
    /// other sides than the camera's own axes.
    LensPictures(double near_m, const PictureParams& look,
                 const Eigen::Quaterniond& sides_from_camera = Eigen::Quaterniond::Identity());

    /// Makes what draw() will draw into, so that it does not fail for its size or for memory.
    [[nodiscard]] Status prepare(const LensModel& lens);

    /// 3 bytes a pixel, sRGB; black outside of the lens's image circle. `rays` are of the scene as
    /// the renderer has it.
    [[nodiscard]] Status draw(const LensModel& lens, const Pose& pose, SceneRenderer& renderer,
                              const RayCaster& rays, std::vector<std::uint8_t>& rgb);

    /// One picture that a wide lens is put together from.
    struct Side {
        Eigen::Quaterniond camera_from_side = Eigen::Quaterniond::Identity();
        double reach = 1.0;  // tangent of the angle from its axis to its borders
        int size_px = 0;
        bool alone = false;  // there is no other to fade into
        bool finer = false;  // than the lens is from row to row
    };
    /// Those that show anything of what the lens sees.
    [[nodiscard]] std::vector<Side> sidesFor(const LensModel& lens) const;

  private:
    [[nodiscard]] Result<RenderTarget*> targetOf(int width, int height);
    [[nodiscard]] Status drawView(const View& view, SceneRenderer& renderer, const RayCaster& rays,
                                  std::vector<std::uint8_t>& rgb);

    double near_m_;
    PictureParams look_;
    Eigen::Quaterniond sides_from_camera_;
    std::map<std::pair<int, int>, RenderTarget> targets_;  // by size
};

/// What draws a pinhole or an orthographic lens.
[[nodiscard]] View viewThrough(const LensModel& lens, const Pose& pose, double near_m);

}  // namespace dollytrack::render
