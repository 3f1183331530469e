#include "render/pathtrace/path_tracer.h"

#include "engine/jobs/parallel.h"
#include "engine/scene/srgb.h"
#include "render/light/light_sample.h"
#include "render/light/sun_rays.h"
#include "render/light/tone_curve.h"
#include "render/materials/layer_albedo.h"
#include "render/materials/surface_brdf.h"
#include "render/pathtrace/denoiser.h"
#include "render/pathtrace/path_light.h"
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
// Where paths may end in the light volume: not nearer than this to their last surface, in cells of
// the volume, and only if their direction was sampled with a lower density, 1/sr, so that
// reflections that are nearly sharp are traced further.
constexpr double kMinEndDistanceCells = 2.5;
constexpr double kMaxEndDensity = 8.0;
constexpr int kRowStep = kDenoisedRows / 4;  // a multiple of the denoiser's strides
constexpr int kMostSheets = 64;              // of glass or holes along one path segment

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

/// Whether a surface is a pane that mostly shows what is behind it.
bool isClear(const SurfacePoint& point) {
    return point.kind == Surface::Glass && point.opacity <= 0.5;
}

/// Whether a surface shows others nearly sharply.
bool isMirrorLike(const SurfacePoint& point) {
    return point.metallic > 0.5F && point.roughness < 0.2F;
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

    /// One path along a ray.
    [[nodiscard]] LayeredLight sample(const std::optional<ViewRay>& ray, double near_m,
                                      const std::optional<Eigen::Vector3f>& backdrop,
                                      SampleSequence& chance) const;
    Status add(const RayThrough& ray_through, double near_m,
               const std::optional<Eigen::Vector3f>& backdrop, int samples, LayeredImage& image,
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

    /// Light that arrives directly from a sampled lamp (`shining` 0) or emitting triangle (1), by
    /// layer of the surface, weighted by the power heuristic.
    void direct(const std::optional<LightSample>& light, const SurfacePoint& point,
                const Frame& frame, const SurfaceBrdf& brdf, std::uint32_t shining,
                Reflected& reflected) const {
        if (!light) return;
        const Eigen::Vector3d in = frame.toLocal(light->way);
        if (in.z() <= 0.0 || light->way.dot(point.face) <= 0.0) return;
        const SurfaceBrdf::Layers value = brdf.layers(in);
        if (value.diffuse <= 0.0F && value.glossy.maxCoeff() <= 0.0F) return;
        const Eigen::Vector3d from = liftedOff(point, light->way);
        double free = light->free - (from - point.position).dot(light->way);
        if (shining != 0) {  // ends before the triangle itself, by a rounding margin
            free -= 4e-5 * (1.0 + (from + free * light->way).cwiseAbs().maxCoeff());
        }
        const double share = transmitted(from, light->way, free);
        if (share <= 0.0) return;
        const double weight = weightOf(light->density, brdf.density(in));
        reflected.add(
            value, light->radiance * static_cast<float>(share * weight * in.z() / light->density));
    }

    /// Direct sunlight. The sun is only sampled, because BRDF samples would hardly ever hit it.
    void sunlight(const SurfacePoint& point, const Frame& frame, const SurfaceBrdf& brdf,
                  const std::array<double, 2>& where, Reflected& reflected) const {
        const Frame around(rig.sun.way);
        const double aside = kSunRadius * std::sqrt(where[0]);
        const double angle = 2.0 * std::numbers::pi * where[1];
        const Eigen::Vector3d way = around.toWorld(
            {aside * std::cos(angle), aside * std::sin(angle), std::sqrt(1.0 - aside * aside)});
        const Eigen::Vector3d in = frame.toLocal(way);
        if (in.z() <= 0.0 || way.dot(point.face) <= 0.0) return;
        const SurfaceBrdf::Layers value = brdf.layers(in);
        if (value.diffuse <= 0.0F && value.glossy.maxCoeff() <= 0.0F) return;
        const double share = sun_rays.share(liftedOff(point, way), way);
        reflected.add(value, rig.sun.irradiance * static_cast<float>(share * in.z()));
    }

    /// Light of a path's last surface by the light volume.
    [[nodiscard]] Eigen::Vector3f endLight(const SurfacePoint& point) const;
    /// Whether a path of this length from its last surface, sampled with this density, ends here.
    [[nodiscard]] bool endsAt(const SurfacePoint& point, const Gathered& gathered, double length,
                              double density) const;
    /// Has the layers describe the surface behind a pane that the camera sees, whether or not the
    /// path passes the pane, so that they are free of noise.
    void meetBehind(const SurfacePoint& pane, const Eigen::Vector3d& way,
                    const Eigen::Vector3d& camera, Gathered& gathered) const;
    /// Adds the light that a surface itself sends along a path from `from`, whose direction was
    /// sampled with this density. Returns true if the path ends there: windows send daylight.
    [[nodiscard]] bool takesEmission(const RayHit& hit, const Eigen::Vector3d& way,
                                     const Eigen::Vector3d& from, double density,
                                     SurfacePoint& point, Gathered& gathered) const;
    /// Direct light that a surface reflects.
    [[nodiscard]] Reflected reflected(const SurfacePoint& point, const Frame& frame,
                                      const SurfaceBrdf& brdf, std::uint32_t step,
                                      SampleSequence& chance) const;

    [[nodiscard]] LayeredLight follow(Eigen::Vector3d origin, Eigen::Vector3d way, double nearest,
                                      const Eigen::Vector3f& backdrop,
                                      SampleSequence& chance) const;
};

Reflected PathTracer::Impl::reflected(const SurfacePoint& point, const Frame& frame,
                                      const SurfaceBrdf& brdf, std::uint32_t step,
                                      SampleSequence& chance) const {
    Reflected sum;
    if (params.sample_lights) {
        const double lamp = chance.next();
        const auto on_lamp = chance.nextPair();
        const double triangle = chance.next();
        const auto on_triangle = chance.nextPair();
        direct(lights.sampleLamp(point.position, lamp, on_lamp), point, frame, brdf, 0, sum);
        direct(lights.sampleTriangle(point.position, triangle, on_triangle), point, frame, brdf, 1,
               sum);
    }
    if (rig.sun.shines()) {
        chance.jumpTo(kFirstDimension + step * kDimensionsPerStep + 12);
        sunlight(point, frame, brdf, chance.nextPair(), sum);
    }
    return sum;
}

void PathTracer::Impl::meetBehind(const SurfacePoint& pane, const Eigen::Vector3d& way,
                                  const Eigen::Vector3d& camera, Gathered& gathered) const {
    if (gathered.light.hits > 0.0F) return;
    SurfacePoint point = pane;
    for (int sheet = 0; sheet < kMostSheets && (point.hole || isClear(point)); ++sheet) {
        const Eigen::Vector3d origin = liftedOff(point, way);
        const RayHit hit = rays.cast(origin, way, kInfinity);
        if (hit.object_id == 0) return;
        point = surface.at(origin, way, hit);
    }
    point.base_color = point.base_color.cwiseMax(0.0F).cwiseMin(1.0F);
    gathered.meet(point, camera);
}

bool PathTracer::Impl::endsAt(const SurfacePoint& point, const Gathered& gathered, double length,
                              double density) const {
    if (params.end_light == nullptr || gathered.scattered == 0) return false;
    const LightVolume& light = *params.end_light;
    const Eigen::Vector3d cell = (point.position - light.low) / light.cell_m;
    const bool inside = cell.x() > 0.0 && cell.y() > 0.0 && cell.z() > 0.0 &&
                        cell.x() < light.cells[0] && cell.y() < light.cells[1] &&
                        cell.z() < light.cells[2];
    return inside && length > kMinEndDistanceCells * light.cell_m && density < kMaxEndDensity &&
           !isMirrorLike(point);
}

Eigen::Vector3f PathTracer::Impl::endLight(const SurfacePoint& point) const {
    const auto layer = static_cast<float>(meanDielectricAlbedo(point.roughness));
    const float dielectric = 1.0F - point.metallic;
    const Eigen::Vector3f reflected = point.base_color * (1.0F - dielectric * layer) +
                                      Eigen::Vector3f::Constant(dielectric * layer);
    Eigen::Vector3f irradiance = irradianceAt(*params.end_light, point.position, point.normal);
    const double slant = point.normal.dot(rig.sun.way);
    if (rig.sun.shines() && slant > 0.0 && rig.sun.way.dot(point.face) > 0.0) {
        const double share = sun_rays.share(liftedOff(point, rig.sun.way), rig.sun.way);
        irradiance += rig.sun.irradiance * static_cast<float>(share * slant);
    }
    return reflected.cwiseProduct(irradiance) / std::numbers::pi_v<float>;
}

bool PathTracer::Impl::takesEmission(const RayHit& hit, const Eigen::Vector3d& way,
                                     const Eigen::Vector3d& from, double density,
                                     SurfacePoint& point, Gathered& gathered) const {
    const bool daylight = !gathered.seen && sendsDaylight(scene.object(hit.object_id));
    const bool shows_outside = outside[hit.object_id - 1];
    const float shines = rig.shineFactor(shows_outside);
    const Eigen::Vector3f sent =
        daylight ? rig.skyRadiance(way) : Eigen::Vector3f(rig.emissionOf(point.emission) * shines);
    // Surfaces that emit daylight turn dark without it.
    if (shows_outside && !point.emission.isZero(0.0F)) point.base_color *= std::min(shines, 1.0F);
    if (sent.maxCoeff() > 0.0F) {
        const double w = params.sample_lights && !std::isinf(density)
                             ? weightOf(density, lights.triangleDensity(hit.object_id, hit.triangle,
                                                                        from, point.position))
                             : 1.0;
        gathered.arrive(sent * static_cast<float>(w));
    }
    return daylight;
}

LayeredLight PathTracer::Impl::follow(Eigen::Vector3d origin, Eigen::Vector3d way, double nearest,
                                      const Eigen::Vector3f& backdrop,
                                      SampleSequence& chance) const {
    const Eigen::Vector3d camera = origin;
    Gathered gathered;
    Eigen::Vector3d scattered_at = origin;  // where the direction was sampled
    double density = kInfinity;             // density of the sampled direction, 1/sr
    int bounces = 0;
    int sheets = 0;
    for (std::uint32_t step = 0;; ++step) {
        chance.jumpTo(kFirstDimension + step * kDimensionsPerStep);
        const RayHit hit = rays.cast(origin, way, kInfinity, nearest);
        nearest = 0.0;
        const double behind = (origin - scattered_at).dot(way);
        if (!gathered.seen) {
            const double end = hit.object_id != 0 ? behind + hit.distance : kInfinity;
            lights.visitLamps(scattered_at, way, sheets == 0 ? 0.0 : behind, end,
                              [&](const Eigen::Vector3f& sent, double other) {
                                  const double w =
                                      params.sample_lights ? weightOf(density, other) : 1.0;
                                  gathered.arrive(sent * static_cast<float>(w));
                              });
        }
        if (hit.object_id == 0) {
            gathered.arrive(gathered.seen ? backdrop : rig.skyRadiance(way));
            break;
        }
        SurfacePoint point = surface.at(origin, way, hit);
        if (point.hole) {
            if (++sheets > kMostSheets) break;
            origin = liftedOff(point, way);
            continue;
        }
        point.base_color = point.base_color.cwiseMax(0.0F).cwiseMin(1.0F);
        if (takesEmission(hit, way, scattered_at, density, point, gathered)) break;
        if (point.kind == Surface::Glass) {
            const double thrown = sheetReflectance(-way.dot(point.normal));
            const double which = chance.next();
            if (which < thrown) {
                if (gathered.seen) meetBehind(point, way, camera, gathered);
                way -= 2.0 * way.dot(point.normal) * point.normal;
                if (way.dot(point.face) <= 0.0 || ++bounces > params.max_bounces) break;
                origin = scattered_at = liftedOff(point, way);
                density = kInfinity;
                gathered.seen = false;
                sheets = 0;
                continue;
            }
            if (which >= thrown + (1.0 - thrown) * point.opacity) {
                if (gathered.seen && !isClear(point)) meetBehind(point, way, camera, gathered);
                if (++sheets > kMostSheets) break;
                origin = liftedOff(point, way);
                continue;
            }
        } else {
            (void)chance.next();
        }

        const bool first = gathered.seen && gathered.light.hits == 0.0F && !isClear(point);
        if (first) gathered.meet(point, camera);
        if (gathered.seen && !first) meetBehind(point, way, camera, gathered);
        if (endsAt(point, gathered, behind + hit.distance, density)) {
            gathered.reflect({Eigen::Vector3f::Zero(), endLight(point)}, point.base_color, false);
            break;
        }
        const Frame frame(point.normal);
        const SurfaceBrdf brdf(point.base_color, point.metallic, point.roughness,
                               frame.toLocal(-way));
        gathered.reflect(reflected(point, frame, brdf, step, chance), point.base_color, first);
        if (++bounces > params.max_bounces) break;
        chance.jumpTo(kFirstDimension + step * kDimensionsPerStep + 8);
        const double layer = chance.next();
        const Eigen::Vector3d in = brdf.sample(layer, chance.nextPair());
        density = brdf.density(in);
        if (in.z() <= 0.0 || density <= 0.0) break;
        way = frame.toWorld(in).normalized();
        if (way.dot(point.face) <= 0.0) break;
        gathered.scatter(brdf.layers(in), point.base_color, static_cast<float>(in.z() / density),
                         first);
        if (bounces >= kRouletteFrom) {
            const double stays = std::min(0.95, static_cast<double>(gathered.strongest()));
            if (!(chance.next() < stays)) break;
            gathered.divide(static_cast<float>(stays));
        }
        origin = liftedOff(point, way);
        scattered_at = point.position;
        sheets = 0;
    }
    return gathered.light.sum().allFinite() ? gathered.light : LayeredLight{};
}

PathTracer::PathTracer(const Scene& scene, const RayCaster& rays, const LightRig& rig,
                       const PathTracerParams& params, const MovedShape* moved)
    : impl_(std::make_unique<Impl>(scene, rays, rig, params, moved)) {}
PathTracer::~PathTracer() = default;

Status PathTracer::add(const View& view, int samples, LayeredImage& image,
                       const JobContext& job) const {
    image.width = view.intrinsics.width;
    image.height = view.intrinsics.height;
    const auto rayThrough = [&](double x, double y) { return view.rayThrough(x, y); };
    return impl_->add(rayThrough, view.near_m, view.backdrop, samples, image, job);
}

Status PathTracer::add(const RayThrough& ray_through, double near_m, int samples,
                       LayeredImage& image, const JobContext& job) const {
    return impl_->add(ray_through, near_m, std::nullopt, samples, image, job);
}

LayeredLight PathTracer::Impl::sample(const std::optional<ViewRay>& ray, double near_m,
                                      const std::optional<Eigen::Vector3f>& backdrop,
                                      SampleSequence& chance) const {
    if (!ray) return {};
    const double length = ray->direction.norm();
    const Eigen::Vector3d way = ray->direction / length;
    const Eigen::Vector3f shown =
        backdrop ? *backdrop : skyBackdrop(static_cast<float>(way.z()), rig.backdrop_grey);
    const Eigen::Vector3f linear = decoded(shown).cwiseProduct(
        backdrop ? Eigen::Vector3f(Eigen::Vector3f::Ones()) : rig.backdrop_factor);
    const float radiance_shown = params.exposure * std::numbers::pi_v<float>;
    return follow(ray->origin, way, near_m * length, inverseToneCurve(linear) / radiance_shown,
                  chance);
}

Status PathTracer::Impl::add(const RayThrough& ray_through, double near_m,
                             const std::optional<Eigen::Vector3f>& backdrop, int samples,
                             LayeredImage& image, const JobContext& job) const {
    const auto width = static_cast<std::size_t>(image.width);
    auto sets = image.sets;
    for (auto& set : sets) set.resize(width * image.height);
    const int count = static_cast<int>(sets.size());
    parallelFor(static_cast<std::size_t>(image.height), [&](std::size_t y) {
        const auto row = static_cast<std::size_t>(image.first_row) + y;
        for (std::size_t x = 0; x < width && !job.cancelled(); ++x) {
            for (int k = image.samples; k < image.samples + samples; ++k) {
                const int number = image.first_sample + k;
                const auto pixel = static_cast<std::uint32_t>(row * width + x);
                // All samples share the positions in the pixel, which makes edges smoother.
                SampleSequence in_pixel(params.seed, pixel, static_cast<std::uint32_t>(number));
                const auto [right, down] = in_pixel.nextPair();
                SampleSequence chance(params.seed + static_cast<std::uint32_t>(number % count),
                                      pixel, static_cast<std::uint32_t>(number / count));
                sets[number % count][y * width + x] += sample(
                    ray_through(static_cast<double>(x) + right, static_cast<double>(row) + down),
                    near_m, backdrop, chance);
            }
        }
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "path tracing was cancelled");
    image.sets = std::move(sets);
    image.samples += samples;
    return {};
}

Result<PictureLayers> PathTracer::take(const RayThrough& ray_through, double near_m,
                                       const Picture& picture, const JobContext& job) const {
    const int rows = std::max(1, picture.pixels_at_once / std::max(picture.width, 1) / kRowStep);
    const int margin = picture.denoises ? kDenoisedRows : 0;
    PictureLayers layers;
    for (int begin = 0; begin < picture.height; begin += rows * kRowStep) {
        const int end = std::min(begin + rows * kRowStep, picture.height);
        LayeredImage image;
        image.width = picture.width;
        image.first_row = std::max(begin - margin, 0);
        image.height = std::min(end + margin, picture.height) - image.first_row;
        image.first_sample = picture.first_sample;
        if (picture.denoises) image.sets.resize(2);
        const JobContext part = job.stage(static_cast<double>(begin) / picture.height,
                                          static_cast<double>(end) / picture.height, "");
        // Both sets get the same number.
        const int samples =
            picture.denoises ? std::max(2, picture.samples + picture.samples % 2) : picture.samples;
        Status status = add(ray_through, near_m, samples, image, part);
        if (!status) return tl::unexpected(status.error());
        const PictureLayers finished =
            picture.denoises ? denoised(image, picture.scale) : averaged(image, picture.scale);
        const auto width = static_cast<std::size_t>(picture.width);
        layers.append(finished, width * (begin - image.first_row), width * (end - image.first_row));
    }
    return layers;
}

Eigen::Vector3f PathTracer::radiance(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                                     std::uint32_t pixel, std::uint32_t sample) const {
    SampleSequence chance(impl_->params.seed, pixel, sample);
    return impl_->follow(from, way, 0.0, impl_->rig.skyRadiance(way), chance).sum();
}

}  // namespace dollytrack::render
