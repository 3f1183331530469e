#pragma once

#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"
#include "render/light/light_volume.h"
#include "render/materials/traced_surface.h"
#include "render/pathtrace/layered_image.h"
#include "render/view/view.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// Settings of the path tracer.
struct PathTracerParams {
    std::uint32_t seed = 1;
    int max_bounces = 64;       // Russian roulette ends nearly all paths earlier
    bool sample_lights = true;  // false: unbiased but noisy, without light sampling
    float exposure = 1.0F;      // of the developed image; backdrops are scaled to keep their colour
    /// If set, paths end at their second surface with the light of this volume, except near the
    /// first surface: several times faster, with the volume's small errors in indirect light. It
    /// must outlive the tracer.
    const LightVolume* end_light = nullptr;
};

/// Unidirectional path tracer, the reference for drawn images. Paths start at the camera (Kajiya
/// 1986); light sampling and BRDF sampling are combined by the power heuristic (Veach 1997). Glass
/// is a thin sheet without refraction, both sides of a triangle count, and cut-outs have their
/// holes. Thread-safe. Keeps references to scene, rays and moved shape.
class PathTracer {
  public:
    /// @param moved  current vertex positions if objects moved, else null; `rays` must match
    PathTracer(const Scene& scene, const RayCaster& rays, const LightRig& rig,
               const PathTracerParams& params = {}, const MovedShape* moved = nullptr);
    ~PathTracer();

    /// Adds samples to each pixel of the view; an empty image is allocated. The result is identical
    /// to the last bit for any number of calls and threads. Hidden objects and structure cuts of
    /// the view are ignored. Returns Cancelled and leaves the image unchanged if the job was
    /// cancelled.
    [[nodiscard]] Status add(const View& view, int samples, LayeredImage& image,
                             const JobContext& job = {}) const;

    /// The same for rays through image positions of any lens; no ray means black. `image` must have
    /// its size set.
    using RayThrough = std::function<std::optional<ViewRay>(double x, double y)>;
    [[nodiscard]] Status add(const RayThrough& ray_through, double near_m, int samples,
                             LayeredImage& image, const JobContext& job = {}) const;

    /// An image to trace and finish. `scale`: exposure times pi.
    struct Picture {
        int width = 0;
        int height = 0;
        int samples = 16;      // rounded up to an even number if it denoises
        int first_sample = 0;  // see LayeredImage
        float scale = 1.0F;
        bool denoises = false;
        int pixels_at_once = 1 << 20;  // bounds the memory; it does not change the result
    };
    /// Traces an image in parts of whole rows and averages or denoises them.
    [[nodiscard]] Result<PictureLayers> take(const RayThrough& ray_through, double near_m,
                                             const Picture& picture,
                                             const JobContext& job = {}) const;

    /// Radiance that arrives at a point from the direction `way`, by one path.
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                                           std::uint32_t pixel, std::uint32_t sample) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::render
