#pragma once

#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/draw/view.h"
#include "render/light/light_rig.h"
#include "render/pathtrace/traced_surface.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// How paths are traced. Plain data.
struct PathTracerParams {
    std::uint32_t seed = 1;
    int max_bounces = 64;       // Russian roulette ends nearly all paths before
    bool sample_lights = true;  // without, light is found by chance alone: right, and noisy
    float exposure = 1.0F;  // as the picture will be developed, for backdrops to keep their look
};

/// A picture that grows better with every sample: radiance, linear RGB, summed over the samples of
/// each pixel; rows from the top.
struct RadianceImage {
    int width = 0;
    int height = 0;
    int samples = 0;
    std::vector<Eigen::Vector3f> sum;

    [[nodiscard]] Eigen::Vector3f at(int x, int y) const {
        return sum[static_cast<std::size_t>(y) * width + x] / static_cast<float>(samples);
    }
};

/// Follows light through a scene as it goes: the reference that drawn pictures are judged by.
/// Paths start at the camera (Kajiya 1986); at each surface lights are sampled as well as the
/// surface's own directions, weighed by the power heuristic (Veach 1997). Glass is a thin sheet
/// without refraction, both sides of a triangle count, cut-outs have their holes. Const and for
/// many threads; keeps references to scene, rays, rig and shape.
class PathTracer {
  public:
    /// `moved`, where things are not where the scene has them; `rays` are of them there.
    PathTracer(const Scene& scene, const RayCaster& rays, const LightRig& rig,
               const PathTracerParams& params = {}, const MovedShape* moved = nullptr);
    ~PathTracer();

    /// Adds samples to each pixel of the view; an empty image is made. The result is the same to
    /// the last bit in one call or in many, on any number of threads. What View can leave away
    /// (hidden objects, cut structure) is not left away. Error: Cancelled; the image is then what
    /// it was.
    [[nodiscard]] Status add(const View& view, int samples, RadianceImage& image,
                             const JobContext& job = {}) const;

    /// The same for rays of any lens through image positions; nothing where it has no picture. The
    /// image has its size.
    using RayThrough = std::function<std::optional<ViewRay>(double x, double y)>;
    [[nodiscard]] Status add(const RayThrough& ray_through, double near_m, int samples,
                             RadianceImage& image, const JobContext& job = {}) const;

    /// Radiance that comes to a point along -way, by one path.
    [[nodiscard]] Eigen::Vector3f radiance(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                                           std::uint32_t pixel, std::uint32_t sample) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The picture's bytes, 3 a pixel, sRGB. White surfaces in the light that `exposure` is made for
/// (LightVolume::exposure) are light grey.
[[nodiscard]] std::vector<std::uint8_t> developed(const RadianceImage& image, float exposure);

}  // namespace dollytrack::render
