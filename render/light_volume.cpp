#include "render/light_volume.h"

#include "engine/core/random.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/labels.h"
#include "render/light_cells.h"
#include "render/pathtrace/sun_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr double kReach = 9.0;    // m; farther lamps add too little to be worth a ray
constexpr int kShadowRays = 6;    // per lamp and cell
constexpr int kNearestLamps = 4;  // considered per cell
constexpr std::size_t kNearestOwnLamps = 6;
constexpr int kOwnShadowRays = 9;
constexpr double kOffSurface = 2e-3;    // m; of places that light falls on
constexpr float kWhiteLevel = 0.62F;    // linear value of a white surface in average light
constexpr float kDaylightShare = 0.7F;  // of the lamps' light, at most, in the middle of rooms

/// Where a ray from a cell ended.
struct Bounce {
    Eigen::Vector3f albedo = Eigen::Vector3f::Zero();
    Eigen::Vector3f sent = Eigen::Vector3f::Zero();  // by itself: emission or sky
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    float distance = 0.0F;  // 0: nothing was hit
    std::size_t cell = 0;   // whose light falls on it
};

class Baker {
  public:
    Baker(const Scene& scene, const RayCaster& rays, const LightRig& rig,
          const LightVolumeParams& params)
        : scene_(scene),
          rays_(rays),
          rig_(rig),
          neutral_(rig),
          params_(params),
          cells_(scene.room_bounds, params.cell_m, params.max_cells) {
        const std::size_t count = cells_.count();
        volume_.low = cells_.low();
        volume_.cell_m = cells_.size_m();
        volume_.cells = cells_.along();
        volume_.ambient.assign(count, Eigen::Vector3f::Zero());
        volume_.slope.assign(count, Eigen::Vector3f::Zero());
        volume_.lamps.assign(count, Eigen::Vector3f::Zero());
        setStrengths(rig, volume_);
        // What the balance is made for, before anybody's wishes.
        neutral_.lamp_factor = neutral_.emission_factor = 1.0F;
        neutral_.sky_factor.setOnes();
        if (rig.sun.shines()) {
            sun_rays_.emplace(scene, rays, surface_.emplace(scene, nullptr), rig.sun);
            sunny_.assign(count * static_cast<std::size_t>(params.rays_per_cell), 0.0F);
        }
        bounces_.resize(count * static_cast<std::size_t>(params.rays_per_cell));
        sees_sky_.assign(count, 0);
        balanced_.assign(count, 0.0F);
        for (const bool outside : showsOutside(scene)) {
            shines_.push_back(rig.shineFactor(outside));
        }
        turns_.resize(count);
        makeSpiral();
        for (const Material& material : scene.materials) {
            Eigen::Vector3f albedo = material.base_color;
            const bool textured =
                material.texture >= 0 && scene.textures[material.texture].width > 0;
            if (textured) {
                albedo = albedo.cwiseProduct(meanTexel(scene.textures[material.texture]));
            }
            albedo_.emplace_back(albedo.cwiseMin(0.85F));
            emission_.push_back(neutral_.emissionOf(meanEmission(scene, material)));
        }
    }

    LightVolume bake(const JobContext& job) {
        parallelRanges(cells_.count(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !job.cancelled(); ++i) gather(i);
        });
        if (job.cancelled()) return {};
        cells_.link(rays_);
        leaveOutside();
        cells_.closeHoles(volume_.lamps);
        volume_.lamps = cells_.smoothed(volume_.lamps);
        balance();
        addSun();
        gatherSent();
        if (!rig_.own_lamps.empty()) gatherOwnLamps();
        for (int i = 0; i < params_.bounces; ++i) {
            bounce();
            cells_.closeHoles(volume_.ambient);
            cells_.closeHoles(volume_.slope);
        }
        smoothAmbient();
        joinOwnLamps();
        expose();
        return std::move(volume_);
    }

  private:
    void gather(std::size_t i) {
        Random random(17, i);
        const Eigen::Vector3d from = cells_.center(i);
        volume_.lamps[i] = lampsAt(from, random);
        turns_[i] =
            Eigen::AngleAxisf(static_cast<float>(random.uniform(0.0, 2.0 * std::numbers::pi)),
                              Eigen::Vector3f::UnitZ())
                .toRotationMatrix();
        const auto count = static_cast<std::size_t>(params_.rays_per_cell);
        std::size_t escaped = 0;
        std::size_t stuck = 0;
        for (std::size_t k = 0; k < count; ++k) {
            Bounce& bounce = bounces_[i * count + k];
            const Eigen::Vector3d way = (turns_[i] * spiral_[k]).cast<double>().normalized();
            Eigen::Vector3f wished = rig_.sky_factor;
            bounce = follow(from, way, wished);
            balanced_[i] += bounce.sent.mean();
            bounce.sent = bounce.sent.cwiseProduct(wished);
            if (sun_rays_) sunny_[i * count + k] = sunOn(bounce, from, way);
            escaped += bounce.distance == 0.0F ? 1 : 0;
            stuck += bounce.distance > 0.0F && bounce.distance < volume_.cell_m ? 1 : 0;
        }
        // Behind a wall there is the open sky, inside a cushion there is night; neither may shine
        // through to the surface a few centimetres away. Rooms without a ceiling see their lamps.
        sees_sky_[i] = escaped > 0 ? 1 : 0;
        const bool in_the_dark = volume_.lamps[i].squaredNorm() == 0.0F;
        if (in_the_dark && (4 * escaped > count || 4 * stuck > 3 * count)) cells_.leaveAir(i);
    }

    /// What no way leads to from the rooms' lamps, from cell to cell, and sees the sky, lies behind
    /// a wall: the day there must not shine through where the wall is thinner than cells.
    void leaveOutside() {
        std::vector<std::size_t> lit;
        for (std::size_t i = 0; i < cells_.count(); ++i) {
            if (volume_.lamps[i].squaredNorm() > 0.0F) lit.push_back(i);
        }
        if (lit.empty()) return;
        const std::vector<char> reached = cells_.reachedFrom(lit);
        for (std::size_t i = 0; i < reached.size(); ++i) {
            if (reached[i] == 0 && sees_sky_[i] != 0) cells_.leaveAir(i);
        }
    }

    [[nodiscard]] Eigen::Vector3f lampsAt(const Eigen::Vector3d& from, Random& random) const {
        std::vector<std::pair<double, const Lamp*>> near;  // by what they would give unshaded
        for (const Lamp& lamp : rig_.lamps) {
            const Eigen::Vector3d way = lamp.position - from;
            const double squared = way.squaredNorm() + lamp.radius_m * lamp.radius_m;
            if (way.z() <= 0.0 || squared > kReach * kReach) continue;
            near.emplace_back(lamp.intensity * way.z() / (squared * std::sqrt(squared)), &lamp);
        }
        std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first > b.first : a.second < b.second;
        });
        if (near.size() > kNearestLamps) near.resize(kNearestLamps);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const auto& [unshaded, lamp] : near) {
            const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
            for (int k = 0; k < kShadowRays; ++k) {
                const double angle = turn + k * 2.0 * std::numbers::pi / kShadowRays;
                const double r = lamp->radius_m * std::sqrt((k + random.uniform()) / kShadowRays);
                const Eigen::Vector3d at =
                    lamp->position + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0);
                const Eigen::Vector3d way = at - from;
                const double distance = way.norm();
                const double down = way.z() / distance;
                const double free = std::max(0.0, 1.0 - kLampShade / distance);  // see light_rig.h
                if (down <= 0.0 || !rays_.sees(from, from + free * way)) continue;
                const double strength =
                    lamp->radiance() * lamp->area() * down / (distance * distance);
                sum += way * (strength / distance / kShadowRays);
            }
        }
        return sum.cast<float>();
    }

    void gatherOwnLamps() {
        own_.assign(cells_.count(), Eigen::Vector3f::Zero());
        parallelRanges(own_.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Random random(18, i);
                own_[i] = ownLampsAt(i, random);
            }
        });
        cells_.closeHoles(own_);
    }

    [[nodiscard]] Eigen::Vector3f ownLampsAt(std::size_t i, Random& random) const {
        const Eigen::Vector3d from = cells_.center(i);
        std::vector<std::pair<double, const OwnLamp*>> near;  // by what they would give unshaded
        for (const OwnLamp& lamp : rig_.own_lamps) {
            const double squared = (lamp.position - from).squaredNorm();
            if (squared < kReach * kReach) near.emplace_back(-lamp.intensity / squared, &lamp);
        }
        std::sort(near.begin(), near.end());  // lamps are in one array
        if (near.size() > kNearestOwnLamps) near.resize(kNearestOwnLamps);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const auto& [unshaded, lamp] : near) {
            const Eigen::Vector3d at = litPlace(i, *lamp);
            const Eigen::Vector3d way = lamp->position - at;
            // What is nearer than the grid can tell is the lamp itself.
            const double least = std::max(lamp->radius_m, 0.5 * volume_.cell_m);
            const double squared = std::max(way.squaredNorm(), least * least);
            sum += way.normalized() *
                   (lamp->intensity / squared * visibleShare(from, at, *lamp, random));
        }
        return sum.cast<float>();
    }

    /// Light of a lamp so near falls off steeply, and the volume is looked up off the surfaces: a
    /// cell beside one has the light that falls there. The place on the nearest surface that the
    /// lamp shines on, but its own; else the cell's middle.
    [[nodiscard]] Eigen::Vector3d litPlace(std::size_t i, const OwnLamp& lamp) const {
        const Eigen::Vector3d from = cells_.center(i);
        const auto count = static_cast<std::size_t>(params_.rays_per_cell);
        Eigen::Vector3d nearest = from;
        double least = 2.1 * volume_.cell_m;  // twice what look-ups are off, as cells interpolate
        for (std::size_t k = 0; k < count; ++k) {
            const Bounce& ray = bounces_[i * count + k];
            if (isSky(ray) || ray.distance > 4.0 * volume_.cell_m) continue;
            const Eigen::Vector3d way = (turns_[i] * spiral_[k]).cast<double>().normalized();
            const Eigen::Vector3d normal = ray.normal.cast<double>();
            const double off = -ray.distance * normal.dot(way);
            if (off >= least || lamp.shade.contains(from + ray.distance * way)) continue;
            const Eigen::Vector3d on = from - (off - kOffSurface) * normal;
            if (normal.dot(lamp.position - on) <= 0.0) continue;
            least = off;
            nearest = on;
        }
        return nearest;
    }

    /// Of the ball, from places in the cell as far as they are seen from its middle.
    [[nodiscard]] double visibleShare(const Eigen::Vector3d& cell, const Eigen::Vector3d& at,
                                      const OwnLamp& lamp, Random& random) const {
        int asked = 0;
        int visible = 0;
        for (int k = 0; k < kOwnShadowRays; ++k) {
            Eigen::Vector3d aside;
            Eigen::Vector3d on_ball;
            for (int axis = 0; axis < 3; ++axis) aside[axis] = random.uniform(-0.5, 0.5);
            for (int axis = 0; axis < 3; ++axis) on_ball[axis] = random.uniform(-1.0, 1.0);
            // Along the surface, where there is one.
            const Eigen::Vector3d off = cell - at;
            if (off.squaredNorm() > 1e-8) aside -= off * (off.dot(aside) / off.squaredNorm());
            const Eigen::Vector3d from = k == 0 ? at : at + volume_.cell_m * aside;
            if (k != 0 && !rays_.sees(cell, from)) continue;
            ++asked;
            const Eigen::Vector3d to =
                lamp.position + 0.8 * lamp.radius_m / std::max(on_ball.norm(), 1.0) * on_ball;
            const double distance = (to - from).norm();
            const Eigen::Vector3d way = (to - from) / distance;
            const double end = lamp.shadowedFor(from, way, distance);
            if (end <= 0.0 || rays_.sees(from, from + end * way)) ++visible;
        }
        return static_cast<double>(visible) / asked;
    }

    /// One vector for all lamps is what the pictures are lit by.
    void joinOwnLamps() {
        if (own_.empty()) return;
        volume_.own_share.assign(own_.size(), 0.0F);
        for (std::size_t i = 0; i < own_.size(); ++i) {
            const float own = own_[i].norm();
            if (own == 0.0F) continue;
            volume_.own_share[i] = own / (own + volume_.lamps[i].norm());
            volume_.lamps[i] += own_[i];
        }
    }

    /// The share of the sun's light that a ray's end gets, its slant included.
    [[nodiscard]] float sunOn(const Bounce& bounce, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& way) const {
        if (isSky(bounce)) return 0.0F;
        const Eigen::Vector3d normal = bounce.normal.cast<double>();
        const double slant = normal.dot(rig_.sun.way);
        if (slant <= 0.0) return 0.0F;
        constexpr double kLift = 1e-3;
        const Eigen::Vector3d at = from + bounce.distance * way + kLift * normal;
        return static_cast<float>(slant * sun_rays_->share(at, rig_.sun.way));
    }

    /// Surfaces have normals.
    static bool isSky(const Bounce& bounce) { return bounce.normal.isZero(0.0F); }

    /// As it is balanced; `wished` becomes what is sent from there is multiplied by afterwards, and
    /// stays as it is where it is the sky's.
    [[nodiscard]] Bounce follow(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                                Eigen::Vector3f& wished) const {
        Bounce result;
        const RayHit hit = rays_.cast(from, way);
        if (hit.object_id != 0) {
            result.distance = std::max(static_cast<float>(hit.distance), 1e-6F);
        }
        if (hit.object_id == 0 || sendsDaylight(scene_.object(hit.object_id))) {
            result.sent = neutral_.skyRadiance(way);
            return result;
        }
        const Triangle& triangle = scene_.triangles[hit.triangle];
        const Eigen::Vector3f a = scene_.positions[triangle[0]];
        Eigen::Vector3f normal = (scene_.positions[triangle[1]] - a)
                                     .cross(scene_.positions[triangle[2]] - a)
                                     .normalized();
        if (normal.dot(way.cast<float>()) > 0.0F) normal = -normal;
        result.normal = normal;
        result.albedo = albedo_[scene_.triangle_material[hit.triangle]];
        wished.setConstant(shines_[static_cast<std::size_t>(hit.object_id) - 1]);
        result.sent = emission_[scene_.triangle_material[hit.triangle]];
        const Eigen::Vector3d at = from + way * hit.distance;
        result.cell = cells_.cellAt(at + normal.cast<double>() * (0.8 * volume_.cell_m));
        return result;
    }

    /// What sky, shining things and sunlit places send straight to each cell. Few of its rays find
    /// a small bright one: what they find is shared with the cells around, as far as these are open
    /// to each other.
    void gatherSent() {
        constexpr int kPasses = 8;  // as wide as a cell and a half
        const auto count = static_cast<std::size_t>(params_.rays_per_cell);
        sent_.resize(cells_.count());
        sent_aside_.resize(cells_.count());
        parallelRanges(sent_.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                Eigen::Vector3f aside = Eigen::Vector3f::Zero();
                for (std::size_t k = 0; k < count; ++k) {
                    const Eigen::Vector3f& sent = bounces_[i * count + k].sent;
                    sum += sent;
                    aside += sent.mean() * spiral_[k];
                }
                sent_[i] = sum;
                sent_aside_[i] = turns_[i] * aside;
            }
        });
        for (int pass = 0; pass < kPasses; ++pass) {
            sent_ = cells_.shared(sent_);
            sent_aside_ = cells_.shared(sent_aside_);
        }
    }

    void bounce() {
        std::vector<Eigen::Vector3f> next(cells_.count());
        std::vector<Eigen::Vector3f> slope(cells_.count(), Eigen::Vector3f::Zero());
        const auto count = static_cast<std::size_t>(params_.rays_per_cell);
        const Eigen::Vector3f lamp_light = rig_.lampLight();
        const Eigen::Vector3f own_light = rig_.ownLampLight();
        parallelRanges(next.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                Eigen::Vector3f aside = Eigen::Vector3f::Zero();
                for (std::size_t k = 0; k < count; ++k) {
                    const Bounce& ray = bounces_[i * count + k];
                    const float lamp = std::max(0.0F, ray.normal.dot(volume_.lamps[ray.cell]));
                    const float facing = 1.0F + volume_.slope[ray.cell].dot(ray.normal);
                    Eigen::Vector3f falls =
                        volume_.ambient[ray.cell] * std::max(0.0F, facing) + lamp_light * lamp;
                    if (!own_.empty()) {
                        falls += own_light * std::max(0.0F, ray.normal.dot(own_[ray.cell]));
                    }
                    const Eigen::Vector3f light = ray.albedo.cwiseProduct(falls) / kPi;
                    sum += light;
                    aside += light.mean() * spiral_[k];
                }
                sum += sent_[i];
                next[i] = sum * (kPi / static_cast<float>(count));
                // Of radiance l0 + l1 . way, pi * l0 + 2/3 pi * l1 . n falls on a surface; l1 is
                // three times the mean of radiance * way.
                const Eigen::Vector3f mean_way = turns_[i] * aside + sent_aside_[i];
                if (sum.mean() > 0.0F) slope[i] = mean_way * (2.0F / sum.mean());
            }
        });
        volume_.ambient = std::move(next);
        volume_.slope = std::move(slope);
    }

    /// Evenly over the sphere. Each cell turns it by chance, lest all miss the same thing.
    void makeSpiral() {
        const int count = params_.rays_per_cell;
        for (int k = 0; k < count; ++k) {
            const double z = 1.0 - 2.0 * (k + 0.5) / count;
            const double ring = std::sqrt(1.0 - z * z);
            const double angle = k * 2.399963229728653;
            spiral_.push_back(
                Eigen::Vector3d(ring * std::cos(angle), ring * std::sin(angle), z).cast<float>());
        }
    }

    void smoothAmbient() {
        std::vector<Eigen::Vector3f> aside(cells_.count());
        for (std::size_t i = 0; i < aside.size(); ++i) {
            aside[i] = volume_.slope[i] * volume_.ambient[i].mean();
        }
        volume_.ambient = cells_.smoothed(volume_.ambient);
        aside = cells_.smoothed(aside);
        for (std::size_t i = 0; i < aside.size(); ++i) {
            const float mean = volume_.ambient[i].mean();
            volume_.slope[i].setZero();
            if (mean <= 0.0F) continue;
            volume_.slope[i] = aside[i] / mean;
            if (params_.limit_slopes) volume_.slope[i] = limited(volume_.slope[i]);
        }
    }

    static float median(std::vector<float> values) {
        if (values.empty()) return 0.0F;
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }

    /// Dims sky and emitting things where they would drown the lamps: files give emission in any
    /// unit, and a house without a roof would be all cool daylight.
    void balance() {
        const auto count = static_cast<std::size_t>(params_.rays_per_cell);
        std::vector<float> lamps;
        std::vector<float> others;
        for (std::size_t i = 0; i < cells_.count(); ++i) {
            const float lamp = volume_.lamps[i].norm();
            if (lamp == 0.0F || !cells_.inAir(i)) continue;
            lamps.push_back(lamp);
            others.push_back(balanced_[i] * kPi / static_cast<float>(count));
        }
        const float wanted = kDaylightShare * median(std::move(lamps));
        const float found = median(std::move(others));
        if (found <= wanted || wanted == 0.0F) return;
        volume_.dimmed = wanted / found;
        for (Bounce& bounce : bounces_) bounce.sent *= volume_.dimmed;
    }

    /// What the sun lights sends that on like something that shines.
    void addSun() {
        volume_.sun = rig_.sun;
        volume_.sun.irradiance *= volume_.dimmed;
        for (std::size_t i = 0; i < sunny_.size(); ++i) {
            bounces_[i].sent +=
                bounces_[i].albedo.cwiseProduct(volume_.sun.irradiance) * (sunny_[i] / kPi);
        }
    }

    /// From what the lit cells receive: dark solids and the outside must not decide.
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
        const float middle = median(std::move(levels));
        if (middle > 0.0F) volume_.exposure = kWhiteLevel / middle;
        volume_.exposure *= static_cast<float>(std::exp2(rig_.exposure_ev));
    }

    const Scene& scene_;
    const RayCaster& rays_;
    const LightRig& rig_;
    LightRig neutral_;
    const LightVolumeParams& params_;
    LightCells cells_;
    std::optional<TracedSurface> surface_;
    std::optional<SunRays> sun_rays_;  // where there is a sun
    std::vector<float> sunny_;         // by ray, see sunOn(); empty without a sun
    LightVolume volume_;
    std::vector<Eigen::Vector3f> own_;  // as lamps, of the scene's own; empty without these
    std::vector<Bounce> bounces_;
    std::vector<float> balanced_;              // by cell, what its rays find that sends light
    std::vector<float> shines_;                // by object's id - 1, times its emission
    std::vector<char> sees_sky_;               // by cell
    std::vector<Eigen::Vector3f> sent_;        // by cell, see gatherSent()
    std::vector<Eigen::Vector3f> sent_aside_;  // likewise, times the way it comes from
    std::vector<Eigen::Vector3f> spiral_;      // the ways of a cell's rays, before they are turned
    std::vector<Eigen::Matrix3f> turns_;       // of each cell's spiral, about z
    std::vector<Eigen::Vector3f> albedo_;      // by material
    std::vector<Eigen::Vector3f> emission_;    // likewise
};

}  // namespace

Eigen::Vector3f limited(const Eigen::Vector3f& slope) {
    constexpr float kSteepest = 0.75F;
    const float length = slope.norm();
    return length > kSteepest ? Eigen::Vector3f(slope * (kSteepest / length)) : slope;
}

void setStrengths(const LightRig& rig, LightVolume& volume) {
    volume.lamp_color = rig.lampLight();
    volume.own_color = rig.ownLampLight();
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
