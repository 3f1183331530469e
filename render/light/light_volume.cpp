#include "render/light/light_volume.h"

#include "engine/core/random.h"
#include "engine/jobs/parallel.h"
#include "engine/math/quantile.h"
#include "render/light/irradiance_grid.h"
#include "render/light/lamp_light.h"
#include "render/light/light_bounces.h"
#include "render/light/sun_rays.h"
#include "render/materials/layer_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kWhitest = 0.9F;        // largest albedo
constexpr double kSettled = 2e-3;       // stop when one more bounce adds less than this share
constexpr float kWhiteLevel = 0.62F;    // linear value of a white surface in average light
constexpr std::size_t kPiece = 8192;    // cells between two progress reports
constexpr double kGathered = 0.6;       // progress when all rays are cast
constexpr double kLampsGathered = 0.8;  // progress when the scene's lamps are added, too
constexpr const char* kStage = "light";
constexpr float kDaylightShare = 0.7F;  // daylight may reach this share of lamp light at the median

/// Share of light that a material reflects, by its base colour and its dielectric layer (see
/// SurfaceBrdf). Clamped, because a whiter surface than real ones would never get dark.
Eigen::Vector3f meanAlbedo(const Scene& scene, const Material& material) {
    Eigen::Vector3f base = material.base_color;
    if (material.texture >= 0 && scene.textures[material.texture].width > 0) {
        base = base.cwiseProduct(meanTexel(scene.textures[material.texture]));
    }
    const float layer = (1.0F - material.metallic) * meanDielectricAlbedo(material.roughness);
    return (base * (1.0F - layer) + Eigen::Vector3f::Constant(layer)).cwiseMin(kWhitest);
}

class Baker {
  public:
    Baker(const Scene& scene, const RayCaster& rays, const LightRig& rig,
          const LightVolumeParams& params)
        : scene_(scene),
          rays_(rays),
          rig_(rig),
          neutral_(rig),
          params_(params),
          cells_(scene.room_bounds, params.cell_m, params.max_cells),
          bounces_(scene, rays, cells_, params.rays_per_cell) {
        const std::size_t count = cells_.count();
        volume_.low = cells_.low();
        volume_.cell_m = cells_.size_m();
        volume_.cells = cells_.along();
        volume_.ambient.assign(count, Eigen::Vector3f::Zero());
        volume_.slope.assign(count, Eigen::Vector3f::Zero());
        volume_.lamps.assign(count, Eigen::Vector3f::Zero());
        setStrengths(rig, volume_);
        // The balance is computed for neutral light, before the user's factors.
        neutral_.lamp_factor = neutral_.emission_factor = 1.0F;
        neutral_.sky_factor.setOnes();
        if (rig.sun.shines()) {
            sun_rays_.emplace(scene, rays, surface_.emplace(scene, nullptr), rig.sun);
            sunny_.assign(count * bounces_.perCell(), 0.0F);
        }
        sees_sky_.assign(count, 0);
        sees_much_sky_.assign(count, 0);
        balanced_.assign(count, 0.0F);
        for (const Material& material : scene.materials) {
            albedo_.push_back(meanAlbedo(scene, material));
            emission_.push_back(neutral_.emissionOf(meanEmission(scene, material)));
        }
    }

    LightVolume bake(const JobContext& job) {
        for (std::size_t begin = 0; begin < cells_.count() && !job.cancelled(); begin += kPiece) {
            job.report(kGathered * static_cast<double>(begin) /
                       static_cast<double>(cells_.count()));
            const std::size_t piece = std::min(kPiece, cells_.count() - begin);
            parallelRanges(piece, 64, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) gather(begin + i);
            });
        }
        if (job.cancelled()) return {};
        cells_.link(rays_);
        excludeOutdoorCells();
        excludeUnconnectedCells();
        cells_.blur(volume_.lamps, blurWidth());
        cells_.closeHoles(volume_.lamps);
        balance();
        gatherSent();
        if (!rig_.scene_lamps.empty())
            scene_lamp_light_ = sceneLampsByCell(rig_, rays_, cells_, bounces_,
                                                 job.stage(kGathered, kLampsGathered, kStage));
        gatherLampsReflected();
        double before = 0.0;
        for (int i = 0; i < params_.bounces && !job.cancelled(); ++i) {
            job.report(kLampsGathered + (1.0 - kLampsGathered) * i / params_.bounces);
            bounce();
            cells_.closeHoles(volume_.ambient);
            cells_.closeHoles(volume_.slope);
            const double now = allAmbient();
            if (now - before <= kSettled * now) break;
            before = now;
        }
        if (job.cancelled()) return {};
        smoothAmbient();
        addSceneLamps();
        expose();
        return std::move(volume_);
    }

  private:
    void gather(std::size_t i) {
        Random random(17, i);
        volume_.lamps[i] = roomLampsAt(cells_.center(i), rig_, rays_, random);
        bounces_.follow(i, random);
        const std::size_t count = bounces_.perCell();
        std::size_t escaped = 0;
        std::size_t stuck = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const LightBounce& ray = bounces_.of(i, k);
            const Eigen::Vector3d way = bounces_.way(i, k);
            balanced_[i] += sentAlong(ray, way).mean();
            if (sun_rays_) sunny_[i * count + k] = sunOn(ray, cells_.center(i), way);
            escaped += ray.distance_m == 0.0F ? 1 : 0;
            stuck += ray.distance_m > 0.0F && ray.distance_m < volume_.cell_m ? 1 : 0;
        }
        sees_sky_[i] = escaped > 0 ? 1 : 0;
        sees_much_sky_[i] = 4 * escaped > count ? 1 : 0;
        // Dark cells inside solid objects such as cushions would darken the surfaces nearby.
        if (!isLit(i) && 4 * stuck > 3 * count) cells_.exclude(i);
    }

    [[nodiscard]] bool isLit(std::size_t i) const { return volume_.lamps[i].squaredNorm() > 0.0F; }

    /// Whether a lamp hangs above a cell, near enough to light it if nothing is between.
    [[nodiscard]] bool hasLampAbove(std::size_t i) const {
        const Eigen::Vector3d at = cells_.center(i);
        return std::ranges::any_of(rig_.lamps, [&](const Lamp& lamp) {
            return lamp.position.z() > at.z() && (lamp.position - at).norm() < kLampReach_m;
        });
    }

    /// Excludes outdoor cells: those that see much sky and are neither lit by a lamp nor above the
    /// lamps of a room without a ceiling. A dark cell below a lamp's height is behind a wall.
    void excludeOutdoorCells() {
        std::vector<char> in_room(cells_.count(), 0);
        for (std::size_t i = 0; i < in_room.size(); ++i) {  // from the lowest layer to the highest
            const auto below = cells_.below(i);
            const bool above_lamps = below && in_room[*below] != 0 && !hasLampAbove(i);
            in_room[i] = isLit(i) || above_lamps ? 1 : 0;
            if (in_room[i] == 0 && sees_much_sky_[i] != 0) cells_.exclude(i);
        }
    }

    /// Excludes cells that are not connected to lit ones. Those that see the sky lie behind a wall,
    /// and daylight must not bleed through walls thinner than a cell. Those without any light are
    /// inside columns or cupboards, and their darkness must not bleed out.
    void excludeUnconnectedCells() {
        std::vector<std::size_t> lit;
        std::vector<std::size_t> bright;
        for (std::size_t i = 0; i < cells_.count(); ++i) {
            if (isLit(i)) lit.push_back(i);
            if (isLit(i) || balanced_[i] > 0.0F) bright.push_back(i);
        }
        if (lit.empty()) return;
        const std::vector<char> in_rooms = cells_.reachedFrom(lit);
        const std::vector<char> in_light = cells_.reachedFrom(bright);
        for (std::size_t i = 0; i < in_rooms.size(); ++i) {
            if (in_rooms[i] != 0) continue;
            if (sees_sky_[i] != 0 || in_light[i] == 0) cells_.exclude(i);
        }
    }

    /// Shaders use one irradiance vector for all lamps.
    void addSceneLamps() {
        if (scene_lamp_light_.empty()) return;
        volume_.scene_lamp_share.assign(scene_lamp_light_.size(), 0.0F);
        for (std::size_t i = 0; i < scene_lamp_light_.size(); ++i) {
            const float scene_lamp = scene_lamp_light_[i].norm();
            if (scene_lamp == 0.0F) continue;
            volume_.scene_lamp_share[i] = scene_lamp / (scene_lamp + volume_.lamps[i].norm());
            volume_.lamps[i] += scene_lamp_light_[i];
        }
    }

    /// Share of the sun's irradiance at a ray's hit point, times the cosine of incidence.
    [[nodiscard]] float sunOn(const LightBounce& ray, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& way) const {
        if (ray.isSky()) return 0.0F;
        const Eigen::Vector3d normal = ray.normal().cast<double>();
        const double slant = normal.dot(rig_.sun.way);
        if (slant <= 0.0) return 0.0F;
        constexpr double kLift = 1e-3;
        const Eigen::Vector3d at = from + ray.distance_m * way + kLift * normal;
        return static_cast<float>(slant * sun_rays_->share(at, rig_.sun.way));
    }

    /// Emission, or sky radiance, of neutral light, before the user's factors.
    [[nodiscard]] Eigen::Vector3f sentAlong(const LightBounce& ray,
                                            const Eigen::Vector3d& way) const {
        return ray.isSky() ? neutral_.skyRadiance(way) : emission_[ray.material];
    }

    /// Radiance sent along a cell's ray by sources: sky, emission and sunlit surfaces.
    [[nodiscard]] Eigen::Vector3f sent(std::size_t cell, std::size_t ray) const {
        const LightBounce& bounce = bounces_.of(cell, ray);
        Eigen::Vector3f light = volume_.dimmed * sentAlong(bounce, bounces_.way(cell, ray));
        if (bounce.isSky()) return light.cwiseProduct(rig_.sky_factor);
        light *= rig_.shineFactor(bounce.outside);
        if (!sunny_.empty()) {
            light += albedo_[bounce.material].cwiseProduct(volume_.sun.irradiance) *
                     (sunny_[cell * bounces_.perCell() + ray] / kPi);
        }
        return light;
    }

    /// Direct light from sky, emitters and sunlit surfaces for each cell. Few rays hit a small
    /// bright source, so results are blurred over connected cells.
    void gatherSent() {
        sent_.resize(cells_.count());
        sent_aside_.resize(cells_.count());
        parallelRanges(sent_.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                Eigen::Vector3f aside = Eigen::Vector3f::Zero();
                for (std::size_t k = 0; k < bounces_.perCell(); ++k) {
                    const Eigen::Vector3f light = sent(i, k);
                    sum += light;
                    aside += light.mean() * bounces_.unturned(k);
                }
                sent_[i] = sum;
                sent_aside_[i] = bounces_.turn(i) * aside;
            }
        });
        // Wider than the blur of reflected light, because few rays hit a small bright source.
        const double width = std::max(0.18, 1.5 * volume_.cell_m);
        cells_.blur(sent_, width);
        cells_.blur(sent_aside_, width);
    }

    /// Gathers the lamp light that the surfaces around each cell reflect, which is the same in
    /// every bounce.
    void gatherLampsReflected() {
        lamps_.resize(cells_.count());
        lamps_aside_.resize(cells_.count());
        sumOverRays(
            [this](const LightBounce& ray) -> Eigen::Vector3f {
                if (ray.isSky()) return Eigen::Vector3f::Zero();
                const Eigen::Vector3f normal = ray.normal();
                Eigen::Vector3f incoming =
                    rig_.lampLight() * std::max(0.0F, normal.dot(volume_.lamps[ray.cell]));
                if (!scene_lamp_light_.empty()) {
                    incoming += rig_.sceneLampLight() *
                                std::max(0.0F, normal.dot(scene_lamp_light_[ray.cell]));
                }
                return albedo_[ray.material].cwiseProduct(incoming) / kPi;
            },
            [this](std::size_t i, const Eigen::Vector3f& sum, const Eigen::Vector3f& aside) {
                lamps_[i] = sum;
                lamps_aside_[i] = aside;
            });
    }

    void bounce() {
        // The rays of a cell end in cells far apart. Both values lie side by side, so that a ray
        // needs one memory access.
        struct CellLight {
            Eigen::Vector3f ambient, slope;
        };
        std::vector<CellLight> before(cells_.count());
        for (std::size_t i = 0; i < before.size(); ++i) {
            before[i] = {volume_.ambient[i], volume_.slope[i]};
        }
        sumOverRays(
            [&](const LightBounce& ray) -> Eigen::Vector3f {
                if (ray.isSky()) return Eigen::Vector3f::Zero();
                const CellLight& light = before[ray.cell];
                const float facing = std::max(0.0F, 1.0F + light.slope.dot(ray.normal()));
                return albedo_[ray.material].cwiseProduct(light.ambient) * (facing / kPi);
            },
            [&](std::size_t i, const Eigen::Vector3f& reflected, const Eigen::Vector3f& aside) {
                const Eigen::Vector3f sum = reflected + lamps_[i] + sent_[i];
                volume_.ambient[i] = sum * (kPi / static_cast<float>(bounces_.perCell()));
                volume_.slope[i].setZero();
                // Radiance l0 + l1 . way gives the irradiance pi * l0 + 2/3 pi * l1 . n; l1 is
                // three times the mean of radiance * way.
                const Eigen::Vector3f mean_way =
                    bounces_.turn(i) * (aside + lamps_aside_[i]) + sent_aside_[i];
                if (sum.mean() > 0.0F) volume_.slope[i] = mean_way * (2.0F / sum.mean());
            });
    }

    /// Calls take(cell, sum, aside) for each cell: `sum` adds up radiance(ray) over its rays, and
    /// `aside` the brightness times the ray's direction, which is not yet rotated by turn(cell).
    template <class Radiance, class Take>
    void sumOverRays(const Radiance& radiance, const Take& take) const {
        parallelRanges(cells_.count(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                Eigen::Vector3f aside = Eigen::Vector3f::Zero();
                for (std::size_t k = 0; k < bounces_.perCell(); ++k) {
                    const Eigen::Vector3f light = radiance(bounces_.of(i, k));
                    sum += light;
                    aside += light.mean() * bounces_.unturned(k);
                }
                take(i, sum, aside);
            }
        });
    }

    /// Standard deviation, m, that hides the noise of the rays.
    [[nodiscard]] double blurWidth() const { return std::max(0.06, 0.7 * volume_.cell_m); }

    [[nodiscard]] double allAmbient() const {
        double sum = 0.0;
        for (const Eigen::Vector3f& ambient : volume_.ambient) sum += ambient.sum();
        return sum;
    }

    void smoothAmbient() {
        std::vector<Eigen::Vector3f> aside(cells_.count());
        for (std::size_t i = 0; i < aside.size(); ++i) {
            aside[i] = volume_.slope[i] * volume_.ambient[i].mean();
        }
        for (std::vector<Eigen::Vector3f>* values : {&volume_.ambient, &aside}) {
            cells_.blur(*values, blurWidth());
            cells_.closeHoles(*values);
        }
        for (std::size_t i = 0; i < aside.size(); ++i) {
            const float mean = volume_.ambient[i].mean();
            volume_.slope[i].setZero();
            if (mean <= 0.0F) continue;
            volume_.slope[i] = aside[i] / mean;
            if (params_.limit_slopes) volume_.slope[i] = limited(volume_.slope[i]);
        }
    }

    static float medianOr0(std::vector<float> values) {
        return values.empty() ? 0.0F : upperMedian(std::move(values));
    }

    /// Dims sky, sun and emission where they would drown the lamps: files give emission in any
    /// unit, and a house without a roof would get daylight only.
    void balance() {
        std::vector<float> lamps;
        std::vector<float> others;
        for (std::size_t i = 0; i < cells_.count(); ++i) {
            const float lamp = volume_.lamps[i].norm();
            if (lamp == 0.0F || !cells_.inAir(i)) continue;
            lamps.push_back(lamp);
            others.push_back(balanced_[i] * kPi / static_cast<float>(bounces_.perCell()));
        }
        const float wanted = kDaylightShare * medianOr0(std::move(lamps));
        const float found = medianOr0(std::move(others));
        if (found > wanted && wanted > 0.0F) volume_.dimmed = wanted / found;
        volume_.sun = rig_.sun;
        volume_.sun.irradiance *= volume_.dimmed;
    }

    /// Exposure from lit cells only; dark solids and the outside must not affect it.
    void expose() {
        std::vector<float> levels;
        for (std::size_t i = 0; i < cells_.count(); ++i) {
            const float lamp = volume_.lamps[i].norm();
            if (lamp > 0.0F) {
                levels.push_back(volume_.ambient[i].mean() + 0.6F * lamp * rig_.lamp_factor);
            }
        }
        if (levels.empty()) {
            for (const Eigen::Vector3f& ambient : volume_.ambient) levels.push_back(ambient.mean());
        }
        const float middle = medianOr0(std::move(levels));
        if (middle > 0.0F) volume_.exposure = kWhiteLevel / middle;
        volume_.exposure *= static_cast<float>(std::exp2(rig_.exposure_ev));
    }

    const Scene& scene_;
    const RayCaster& rays_;
    const LightRig& rig_;
    LightRig neutral_;
    const LightVolumeParams& params_;
    IrradianceGrid cells_;
    LightBounces bounces_;
    std::optional<TracedSurface> surface_;
    std::optional<SunRays> sun_rays_;  // only with a sun
    std::vector<float> sunny_;         // by ray, see sunOn(); empty without a sun
    LightVolume volume_;
    std::vector<Eigen::Vector3f> scene_lamp_light_;  // irradiance vectors of the scene lamps, by
                                                     // cell; empty if there are none
    std::vector<float> balanced_;               // by cell: sum of neutral source radiance over its
                                                // rays
    std::vector<char> sees_sky_;                // by cell
    std::vector<char> sees_much_sky_;           // by cell: in a quarter of its rays
    std::vector<Eigen::Vector3f> sent_;         // by cell, see gatherSent()
    std::vector<Eigen::Vector3f> sent_aside_;   // by cell: the same times the incoming direction
    std::vector<Eigen::Vector3f> lamps_;        // by cell, see gatherLampsReflected()
    std::vector<Eigen::Vector3f> lamps_aside_;  // by cell: the same times direction before turn()
    std::vector<Eigen::Vector3f> albedo_;       // by material
    std::vector<Eigen::Vector3f> emission_;     // by material
};

}  // namespace

Eigen::Vector3f limited(const Eigen::Vector3f& slope) {
    constexpr float kSteepest = 0.75F;
    const float length = slope.norm();
    return length > kSteepest ? Eigen::Vector3f(slope * (kSteepest / length)) : slope;
}

void setStrengths(const LightRig& rig, LightVolume& volume) {
    volume.lamp_color = rig.lampLight();
    volume.scene_lamp_color = rig.sceneLampLight();
    volume.lamps_shine = rig.shineFactor(false);
    volume.outside_shines = rig.shineFactor(true);
    volume.backdrop_factor = rig.backdrop_factor;
    volume.backdrop_grey = rig.backdrop_grey;
}

LightRig balanced(LightRig rig, const LightVolume& volume) {
    rig.sky_strength *= volume.dimmed;
    rig.emission_scale *= volume.dimmed;
    rig.sun.irradiance *= volume.dimmed;
    return rig;
}

LightVolume bakeLightVolume(const Scene& scene, const RayCaster& rays, const LightRig& rig,
                            const LightVolumeParams& params, const JobContext& job) {
    return Baker(scene, rays, rig, params).bake(job);
}

}  // namespace dollytrack::render
