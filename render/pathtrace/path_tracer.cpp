#include "render/pathtrace/path_tracer.h"

#include "engine/jobs/parallel.h"
#include "engine/scene/srgb.h"
#include "render/light/sun_rays.h"
#include "render/light/tone_curve.h"
#include "render/materials/surface_brdf.h"
#include "render/pathtrace/sample_sequence.h"
#include "render/pathtrace/scene_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dollytrack::render {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kRouletteFrom = 4;  // bounces: Russian roulette starts here
constexpr std::uint32_t kFirstDimension = 4;
constexpr std::uint32_t kDimensionsPerStep = 16;
constexpr int kMostSheets = 64;  // of glass or holes along one path segment

/// An orthonormal frame around a surface normal.
struct Frame {
    Eigen::Vector3d x, y, z;

    explicit Frame(const Eigen::Vector3d& normal) : z(normal) {
        // Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
        const double sign = std::copysign(1.0, z.z());
        const double a = -1.0 / (sign + z.z());
        const double b = z.x() * z.y() * a;
        x = {1.0 + sign * z.x() * z.x() * a, sign * b, -sign * z.x()};
        y = {b, sign + z.y() * z.y() * a, -z.y()};
    }
    [[nodiscard]] Eigen::Vector3d toLocal(const Eigen::Vector3d& v) const {
        return {v.dot(x), v.dot(y), v.dot(z)};
    }
    [[nodiscard]] Eigen::Vector3d toWorld(const Eigen::Vector3d& v) const {
        return v.x() * x + v.y() * y + v.z() * z;
    }
};

/// Veach's power heuristic for a direction that two sampling strategies could have chosen.
double weightOf(double chosen, double other) {
    if (std::isinf(chosen)) return 1.0;
    return chosen * chosen / (chosen * chosen + other * other);
}

}  // namespace

struct PathTracer::Impl {
    const Scene& scene;
    const RayCaster& rays;
    LightRig rig;
    PathTracerParams params;
    TracedSurface surface;
    SceneLights lights;
    SunRays sun_rays;
    std::vector<bool> outside;  // by id - 1, see showsOutside()

    Impl(const Scene& of, const RayCaster& by, LightRig lit, const PathTracerParams& with,
         const MovedShape* moved)
        : scene(of),
          rays(by),
          rig(std::move(lit)),
          params(with),
          surface(of, moved),
          lights(of, surface, rig),
          sun_rays(of, by, surface, rig.sun),
          outside(showsOutside(of)) {}

    Status add(const RayThrough& ray_through, double near_m,
               const std::optional<Eigen::Vector3f>& backdrop, int samples, RadianceImage& image,
               const JobContext& job) const;

    /// Share of light transmitted over `free` metres from a point.
    [[nodiscard]] double transmitted(Eigen::Vector3d from, const Eigen::Vector3d& way,
                                     double free) const {
        if (free <= 0.0) return 1.0;
        if (rays.sees(from, from + free * (1.0 - 1e-6) * way)) return 1.0;
        if (!surface.anySeenThrough()) return 0.0;
        double share = 1.0;
        for (int sheet = 0; sheet < kMostSheets && share > 0.0; ++sheet) {
            const RayHit hit = rays.cast(from, way, free * (1.0 - 1e-6));
            if (hit.object_id == 0) return share;
            const SurfacePoint point = surface.at(from, way, hit);
            if (!point.hole) {
                // Windows emit the sky's light, so they block other light; only the camera sees
                // through them.
                if (sendsDaylight(scene.object(hit.object_id))) return 0.0;
                if (point.kind != Surface::Glass) return 0.0;
                share *= (1.0 - sheetReflectance(-way.dot(point.normal))) * (1.0 - point.opacity);
            }
            const Eigen::Vector3d next = liftedOff(point, way);
            free -= (next - from).dot(way);
            if (free <= 0.0) return share;
            from = next;
        }
        return 0.0;
    }

    /// Direct light from a sampled lamp (`shining` 0) or emitting triangle (1), weighted by the
    /// power heuristic.
    [[nodiscard]] Eigen::Vector3f direct(const std::optional<LightSample>& light,
                                         const SurfacePoint& point, const Frame& frame,
                                         const SurfaceBrdf& brdf, std::uint32_t shining) const {
        if (!light) return Eigen::Vector3f::Zero();
        const Eigen::Vector3d in = frame.toLocal(light->way);
        if (in.z() <= 0.0 || light->way.dot(point.face) <= 0.0) return Eigen::Vector3f::Zero();
        const Eigen::Vector3f value = brdf.value(in);
        if (value.maxCoeff() <= 0.0F) return Eigen::Vector3f::Zero();
        const Eigen::Vector3d from = liftedOff(point, light->way);
        double free = light->free - (from - point.position).dot(light->way);
        if (shining != 0) {  // ends before the triangle itself, by a rounding margin
            free -= 4e-5 * (1.0 + (from + free * light->way).cwiseAbs().maxCoeff());
        }
        const double share = transmitted(from, light->way, free);
        if (share <= 0.0) return Eigen::Vector3f::Zero();
        const double weight = weightOf(light->density, brdf.density(in));
        return value.cwiseProduct(light->radiance) *
               static_cast<float>(share * weight * in.z() / light->density);
    }

    /// Direct sunlight. The sun is only sampled, because BRDF samples would hardly ever hit it.
    [[nodiscard]] Eigen::Vector3f sunlight(const SurfacePoint& point, const Frame& frame,
                                           const SurfaceBrdf& brdf,
                                           const std::array<double, 2>& where) const {
        const Frame around(rig.sun.way);
        const double aside = kSunRadius * std::sqrt(where[0]);
        const double angle = 2.0 * std::numbers::pi * where[1];
        const Eigen::Vector3d way = around.toWorld(
            {aside * std::cos(angle), aside * std::sin(angle), std::sqrt(1.0 - aside * aside)});
        const Eigen::Vector3d in = frame.toLocal(way);
        if (in.z() <= 0.0 || way.dot(point.face) <= 0.0) return Eigen::Vector3f::Zero();
        const Eigen::Vector3f value = brdf.value(in);
        if (value.maxCoeff() <= 0.0F) return Eigen::Vector3f::Zero();
        const double share = sun_rays.share(liftedOff(point, way), way);
        return value.cwiseProduct(rig.sun.irradiance) * static_cast<float>(share * in.z());
    }

    [[nodiscard]] Eigen::Vector3f follow(Eigen::Vector3d origin, Eigen::Vector3d way,
                                         double nearest, const Eigen::Vector3f& backdrop,
                                         SampleSequence& chance) const;
};

Eigen::Vector3f PathTracer::Impl::follow(Eigen::Vector3d origin, Eigen::Vector3d way,
                                         double nearest, const Eigen::Vector3f& backdrop,
                                         SampleSequence& chance) const {
    Eigen::Vector3f light = Eigen::Vector3f::Zero();
    Eigen::Vector3f carried = Eigen::Vector3f::Ones();
    Eigen::Vector3d scattered_at = origin;  // where the direction was sampled
    double density = kInfinity;             // density of the sampled direction, 1/sr
    bool seen = true;                       // the camera sees this point directly or through glass
    int bounces = 0;
    int sheets = 0;
    for (std::uint32_t step = 0;; ++step) {
        chance.jumpTo(kFirstDimension + step * kDimensionsPerStep);
        const RayHit hit = rays.cast(origin, way, kInfinity, nearest);
        nearest = 0.0;
        const double behind = (origin - scattered_at).dot(way);
        if (!seen) {
            const double end = hit.object_id != 0 ? behind + hit.distance : kInfinity;
            lights.visitLamps(scattered_at, way, sheets == 0 ? 0.0 : behind, end,
                              [&](const Eigen::Vector3f& sent, double other) {
                                  const double w =
                                      params.sample_lights ? weightOf(density, other) : 1.0;
                                  light += carried.cwiseProduct(sent) * static_cast<float>(w);
                              });
        }
        if (hit.object_id == 0) {
            light += carried.cwiseProduct(seen ? backdrop : rig.skyRadiance(way));
            break;
        }
        SurfacePoint point = surface.at(origin, way, hit);
        if (point.hole) {
            if (++sheets > kMostSheets) break;
            origin = liftedOff(point, way);
            continue;
        }
        const bool window = sendsDaylight(scene.object(hit.object_id));
        const bool daylight = !seen && window;
        const bool shows_outside = outside[hit.object_id - 1];
        const float shines = rig.shineFactor(shows_outside);
        const Eigen::Vector3f sent = daylight
                                         ? rig.skyRadiance(way)
                                         : Eigen::Vector3f(rig.emissionOf(point.emission) * shines);
        // Surfaces that emit daylight turn dark without it.
        if (shows_outside && !point.emission.isZero(0.0F))
            point.base_color *= std::min(shines, 1.0F);
        if (sent.maxCoeff() > 0.0F) {
            const double w =
                params.sample_lights && !std::isinf(density)
                    ? weightOf(density, lights.triangleDensity(hit.object_id, hit.triangle,
                                                               scattered_at, point.position))
                    : 1.0;
            light += carried.cwiseProduct(sent) * static_cast<float>(w);
        }
        if (daylight) break;

        if (point.kind == Surface::Glass) {
            const double thrown = sheetReflectance(-way.dot(point.normal));
            const double which = chance.next();
            if (which < thrown) {
                way -= 2.0 * way.dot(point.normal) * point.normal;
                if (way.dot(point.face) <= 0.0 || ++bounces > params.max_bounces) break;
                origin = scattered_at = liftedOff(point, way);
                density = kInfinity;
                seen = false;
                sheets = 0;
                continue;
            }
            if (which >= thrown + (1.0 - thrown) * point.opacity) {
                if (++sheets > kMostSheets) break;
                origin = liftedOff(point, way);
                continue;
            }
        } else {
            (void)chance.next();
        }

        const Frame frame(point.normal);
        const SurfaceBrdf brdf(point.base_color, point.metallic, point.roughness,
                               frame.toLocal(-way));
        if (params.sample_lights) {
            const double lamp = chance.next();
            const auto on_lamp = chance.nextPair();
            const double triangle = chance.next();
            const auto on_triangle = chance.nextPair();
            const Eigen::Vector3f direct_light =
                direct(lights.sampleLamp(point.position, lamp, on_lamp), point, frame, brdf, 0) +
                direct(lights.sampleTriangle(point.position, triangle, on_triangle), point, frame,
                       brdf, 1);
            light += carried.cwiseProduct(direct_light);
        }
        if (rig.sun.shines()) {
            chance.jumpTo(kFirstDimension + step * kDimensionsPerStep + 12);
            light += carried.cwiseProduct(sunlight(point, frame, brdf, chance.nextPair()));
        }
        if (++bounces > params.max_bounces) break;
        chance.jumpTo(kFirstDimension + step * kDimensionsPerStep + 8);
        const double layer = chance.next();
        const Eigen::Vector3d in = brdf.sample(layer, chance.nextPair());
        density = brdf.density(in);
        if (in.z() <= 0.0 || density <= 0.0) break;
        way = frame.toWorld(in).normalized();
        if (way.dot(point.face) <= 0.0) break;
        carried = carried.cwiseProduct(brdf.value(in)) * static_cast<float>(in.z() / density);
        if (bounces >= kRouletteFrom) {
            const double stays = std::min(0.95, static_cast<double>(carried.maxCoeff()));
            if (!(chance.next() < stays)) break;
            carried /= static_cast<float>(stays);
        }
        origin = liftedOff(point, way);
        scattered_at = point.position;
        seen = false;
        sheets = 0;
    }
    return light.allFinite() ? light : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

PathTracer::PathTracer(const Scene& scene, const RayCaster& rays, const LightRig& rig,
                       const PathTracerParams& params, const MovedShape* moved)
    : impl_(std::make_unique<Impl>(scene, rays, rig, params, moved)) {}
PathTracer::~PathTracer() = default;

Status PathTracer::add(const View& view, int samples, RadianceImage& image,
                       const JobContext& job) const {
    image.width = view.intrinsics.width;
    image.height = view.intrinsics.height;
    const auto rayThrough = [&](double x, double y) { return view.rayThrough(x, y); };
    return impl_->add(rayThrough, view.near_m, view.backdrop, samples, image, job);
}

Status PathTracer::add(const RayThrough& ray_through, double near_m, int samples,
                       RadianceImage& image, const JobContext& job) const {
    return impl_->add(ray_through, near_m, std::nullopt, samples, image, job);
}

Status PathTracer::Impl::add(const RayThrough& ray_through, double near_m,
                             const std::optional<Eigen::Vector3f>& backdrop, int samples,
                             RadianceImage& image, const JobContext& job) const {
    const int width = image.width;
    const int height = image.height;
    if (image.sum.empty()) {
        image.sum.assign(static_cast<std::size_t>(width) * height, Eigen::Vector3f::Zero());
    }
    std::vector<Eigen::Vector3f> sum = image.sum;
    const float radiance_shown = params.exposure * std::numbers::pi_v<float>;
    parallelRanges(static_cast<std::size_t>(height), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            for (int x = 0; x < width && !job.cancelled(); ++x) {
                const std::size_t pixel = y * static_cast<std::size_t>(width) + x;
                for (int k = 0; k < samples; ++k) {
                    SampleSequence chance(params.seed, static_cast<std::uint32_t>(pixel),
                                          static_cast<std::uint32_t>(image.samples + k));
                    const auto [right, down] = chance.nextPair();
                    const std::optional<ViewRay> ray =
                        ray_through(x + right, static_cast<double>(y) + down);
                    if (!ray) continue;
                    const double length = ray->direction.norm();
                    const Eigen::Vector3d way = ray->direction / length;
                    const Eigen::Vector3f shown =
                        backdrop ? *backdrop
                                 : skyBackdrop(static_cast<float>(way.z()), rig.backdrop_grey);
                    const Eigen::Vector3f linear = decoded(shown).cwiseProduct(
                        backdrop ? Eigen::Vector3f(Eigen::Vector3f::Ones()) : rig.backdrop_factor);
                    sum[pixel] += follow(ray->origin, way, near_m * length,
                                         inverseToneCurve(linear) / radiance_shown, chance);
                }
            }
        }
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "path tracing was cancelled");
    image.sum = std::move(sum);
    image.samples += samples;
    return {};
}

Eigen::Vector3f PathTracer::radiance(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                                     std::uint32_t pixel, std::uint32_t sample) const {
    SampleSequence chance(impl_->params.seed, pixel, sample);
    return impl_->follow(from, way, 0.0, impl_->rig.skyRadiance(way), chance);
}

std::vector<std::uint8_t> developed(const RadianceImage& image, float exposure) {
    std::vector<std::uint8_t> rgb(3 * image.sum.size());
    const float scale =
        exposure * std::numbers::pi_v<float> / static_cast<float>(std::max(image.samples, 1));
    for (std::size_t i = 0; i < image.sum.size(); ++i) {
        const Eigen::Vector3f shown = toneCurve(image.sum[i] * scale);
        for (int c = 0; c < 3; ++c) rgb[3 * i + c] = encodedByte(shown[c]);
    }
    return rgb;
}

}  // namespace dollytrack::render
