#pragma once

#include "engine/core/result.h"
#include "engine/scene/scene.h"
#include "render/amodal/amodal_masks.h"
#include "render/draw/passes/gpu_scene.h"
#include "render/draw/passes/light_sum.h"
#include "render/draw/passes/render_target.h"
#include "render/draw/passes/surface_target.h"
#include "render/light/light_volume.h"
#include "render/view/view.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace dollytrack::render {

class TracedReflections;

/// Draws one scene. The OpenGL context in which it was created must be current for every call. It
/// keeps no reference to the scene.
class SceneRenderer {
  public:
    [[nodiscard]] static Result<SceneRenderer> create(const Scene& scene, const LightVolume& light,
                                                      Detail detail = Detail::Full);
    ~SceneRenderer();
    SceneRenderer(SceneRenderer&&) noexcept;
    SceneRenderer& operator=(SceneRenderer&&) noexcept;

    /// Replaces the light volume.
    [[nodiscard]] Status setLight(const LightVolume& light);

    /// Changes light strengths only. `light` must have the same grid and the same sun direction;
    /// its `lamps` grid is ignored. Faster than setLight().
    void changeLight(const LightVolume& light);

    /// Allocates the buffers that draw() needs besides a target of this size, so that memory errors
    /// show up early. Returns Usage if the driver cannot multisample at this size.
    [[nodiscard]] Status reserve(int width, int height, Antialias antialias);

    /// Starts drawing colour, depth and ids of a view; reading the target waits for completion. The
    /// target must have the view's image size. In depth and ids every surface is opaque, both sides
    /// of each triangle count, and each pixel shows the surface at its centre. If `surfaces` is
    /// given (created for `target`), normals and base colours of the labelled surfaces are drawn,
    /// too.
    [[nodiscard]] Status draw(const View& view, RenderTarget& target,
                              SurfaceTarget* surfaces = nullptr);

    /// Draws depth and labels; the colour image is unchanged.
    [[nodiscard]] Status drawLabels(const View& view, RenderTarget& target,
                                    SurfaceTarget* surfaces = nullptr);

    /// Clears the target's accumulated light. Linear light before the tone curve is then added by
    /// addLight().
    [[nodiscard]] Status beginLight(RenderTarget& target);
    /// Adds one exposure sample. The weight in each image row depends on how far the sample's time
    /// span overlaps that row's exposure; see LightSum.
    [[nodiscard]] Status addLight(const View& view, const LightSum& sum, RenderTarget& target);

    /// Amodal masks: the pixels that each object would cover if nothing stood in front of it.
    /// Objects outside the image are left out. Waits for the drawing.
    [[nodiscard]] Result<std::vector<RenderedAmodalMask>> drawWhole(
        const View& view, std::span<const int> object_ids);

    /// Moves an object for all later draws: p = motion * p, where p is its position in the scene
    /// given to create(), world frame.
    void place(int object_id, const Eigen::Isometry3d& motion);

    /// Sets the reflections on smooth surfaces; null: the light volume's blurred ambient light.
    /// `reflections` must outlive its use.
    void setReflections(const TracedReflections* reflections);
    /// See render::setAnisotropy().
    void setAnisotropy(int samples);

    /// Number of objects that the last multisampled draw() skipped because others hide them
    /// completely.
    [[nodiscard]] int hiddenByOthers() const;

    /// Whether an object is visible and its bounding box reaches into the image, by id - 1.
    [[nodiscard]] std::vector<bool> inView(const View& view) const;

    /// Starts counting each object's unoccluded pixels on an image extended by `beyond` image
    /// widths and heights past every border. Parts behind the near plane are cut. The pixel grid is
    /// that of draw(). Only one batch may be pending.
    [[nodiscard]] Status startSilhouettes(const View& view, std::span<const int> object_ids,
                                          int beyond = 3);
    /// Pixel counts of the batch from startSilhouettes(), in the order of its ids. Waits for them.
    [[nodiscard]] std::vector<std::uint64_t> finishSilhouettes();

  private:
    struct Impl;
    explicit SceneRenderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
