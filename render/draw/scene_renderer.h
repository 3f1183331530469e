#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene.h"
#include "render/amodal/whole_masks.h"
#include "render/draw/gpu_scene.h"
#include "render/draw/render_target.h"
#include "render/draw/surface_target.h"
#include "render/draw/view.h"
#include "render/light/light_sum.h"
#include "render/light/light_volume.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace dollytrack::render {

class TracedReflections;

/// Draws one scene. Needs the OpenGL context current that it was created in; keeps no reference to
/// the scene.
class SceneRenderer {
  public:
    [[nodiscard]] static Result<SceneRenderer> create(const Scene& scene, const LightVolume& light,
                                                      Detail detail = Detail::Full);
    ~SceneRenderer();
    SceneRenderer(SceneRenderer&&) noexcept;
    SceneRenderer& operator=(SceneRenderer&&) noexcept;

    /// Other light on the same scene.
    [[nodiscard]] Status setLight(const LightVolume& light);

    /// The light it has, in other strengths: `light` has the same grid and its sun stands where it
    /// stood; its `lamps` are not looked at. Quicker than setLight().
    void changeLight(const LightVolume& light);

    /// Makes what draw() needs of this size beside a target, so that it does not fail for memory.
    [[nodiscard]] Status reserve(int width, int height, Antialias antialias);

    /// Starts drawing picture, depth and ids of a view; reading the target waits for them. The
    /// target has the size of the view's image. Everything is opaque in depth and ids, both sides
    /// of each triangle are drawn, and each pixel shows what its centre sees.
    /// With `surfaces`, which lie over the target, also normals and base colours of what is
    /// labelled.
    [[nodiscard]] Status draw(const View& view, RenderTarget& target,
                              SurfaceTarget* surfaces = nullptr);

    /// The same without the picture, which stays what it was.
    [[nodiscard]] Status drawLabels(const View& view, RenderTarget& target,
                                    SurfaceTarget* surfaces = nullptr);

    /// Starts a sum of looks at linear light, before the tone curve, in the target.
    [[nodiscard]] Status beginLight(RenderTarget& target);
    /// Adds a look. A row takes as much of it as look and row have in common of their times.
    [[nodiscard]] Status addLight(const View& view, const LightSum& sum, RenderTarget& target);

    /// What each of these objects would cover of the image if nothing stood before it, of those
    /// that reach into it; waits for the drawing.
    [[nodiscard]] Result<std::vector<WholeMask>> drawWhole(const View& view,
                                                           std::span<const int> object_ids);

    /// From now on the object is drawn elsewhere: p = motion * p of the scene as given, world.
    void place(int object_id, const Eigen::Isometry3d& motion);

    /// What smooth surfaces show from now on; none: the room's blurred light. It must outlive its
    /// use.
    void setReflections(const TracedReflections* reflections);
    /// See render::setAnisotropy().
    void setAnisotropy(int places);

    /// How many objects the last draw() of several looks left out of the picture, since they stand
    /// wholly behind others.
    [[nodiscard]] int hiddenByOthers() const;

    /// Which objects' boxes reach into the image, by id - 1.
    [[nodiscard]] std::vector<bool> inView(const View& view) const;

    /// Starts counting the pixels of each object drawn alone, with nothing before it, on an image
    /// that reaches `beyond` image widths and heights past every border (parts behind the near
    /// plane are cut). Pixels are those of draw(). One batch at a time.
    [[nodiscard]] Status startSilhouettes(const View& view, std::span<const int> object_ids,
                                          int beyond = 3);
    /// The counts, in the order of the ids; waits for them.
    [[nodiscard]] std::vector<std::uint64_t> finishSilhouettes();

  private:
    struct Impl;
    explicit SceneRenderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
