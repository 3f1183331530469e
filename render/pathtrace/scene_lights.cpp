#include "render/pathtrace/scene_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTooNear = 2e-3;  // m, to the ball's centre

double areaOf(const std::array<Eigen::Vector3d, 3>& corners) {
    return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
}

}  // namespace

SceneLights::SceneLights(const Scene& scene, const TracedSurface& surface, const LightRig& rig)
    : scene_(scene), surface_(surface), rig_(rig) {
    for (const Material& material : scene.materials) {
        emission_.push_back(rig.emissionOf(meanEmission(scene, material)).mean());
    }
    for (const bool outside : showsOutside(scene)) shines_.push_back(rig.shineFactor(outside));
    double sum = 0.0;
    for (const Object& object : scene.objects) {
        for (std::uint32_t t = object.first_triangle;
             t < object.first_triangle + object.triangle_count; ++t) {
            const double power = brightness(object.id, t) * areaOf(surface.corners(t));
            if (power <= 0.0) continue;
            sum += power;
            emitters_.push_back({t, object.id});
            power_.push_back(sum);
        }
    }
}

double SceneLights::brightness(int object_id, std::uint32_t triangle) const {
    if (sendsDaylight(scene_.object(object_id))) {
        return rig_.sky_color.cwiseProduct(rig_.sky_factor).mean() * rig_.sky_strength;
    }
    return emission_[scene_.triangle_material[triangle]] * shines_[object_id - 1];
}

double SceneLights::choice(const Lamp& lamp, const Eigen::Vector3d& from) const {
    const Eigen::Vector3d way = lamp.position - from;
    if (way.z() <= 0.0) return 0.0;
    const double squared = way.squaredNorm();
    // Nearly level lamps still reach the point with their near edge.
    const double down = std::max(way.z() / std::sqrt(squared), 0.02);
    return lamp.intensity * down / (squared + lamp.radius_m * lamp.radius_m);
}

double SceneLights::choice(const SceneLamp& lamp, const Eigen::Vector3d& from) const {
    const double squared = (lamp.position - from).squaredNorm();
    return squared > kTooNear * kTooNear ? lamp.intensity / squared : 0.0;
}

double SceneLights::cone(const SceneLamp& lamp, const Eigen::Vector3d& from) {
    const double radius = lamp.radiusFrom(from);
    const double sine2 = radius * radius / (lamp.position - from).squaredNorm();
    return 2.0 * kPi * sine2 / (1.0 + std::sqrt(1.0 - sine2));
}

std::optional<double> SceneLights::toBall(const SceneLamp& lamp, const Eigen::Vector3d& from,
                                          const Eigen::Vector3d& way) {
    const Eigen::Vector3d middle = lamp.position - from;
    const double along = middle.dot(way);
    const double radius = lamp.radiusFrom(from);
    const double outside = middle.squaredNorm() - radius * radius;
    const double root2 = along * along - outside;
    if (outside <= 0.0 || along <= 0.0 || root2 < 0.0) return std::nullopt;
    return along - std::sqrt(root2);
}

LightSample SceneLights::sampleBall(const SceneLamp& lamp, const Eigen::Vector3d& from,
                                    const std::array<double, 2>& where) const {
    const Eigen::Vector3d middle = lamp.position - from;
    const double squared = middle.squaredNorm();
    const double radius = lamp.radiusFrom(from);
    const double sine2 = radius * radius / squared;
    // Uniform over the cone of the ball: 1 - cosine is uniform up to its edge.
    const double below = where[0] * sine2 / (1.0 + std::sqrt(1.0 - sine2));
    const double cosine = 1.0 - below;
    const double sine = std::sqrt(below * (1.0 + cosine));
    const double angle = 2.0 * kPi * where[1];
    const Eigen::Vector3d z = middle / std::sqrt(squared);
    const Eigen::Vector3d x = z.unitOrthogonal();
    LightSample sample;
    sample.way =
        (sine * (std::cos(angle) * x + std::sin(angle) * z.cross(x)) + cosine * z).normalized();
    sample.distance = toBall(lamp, from, sample.way).value_or(middle.dot(sample.way));
    sample.free = lamp.shadowedFor(from, sample.way, sample.distance);
    sample.density = choice(lamp, from) / totalChoice(from) / cone(lamp, from);
    sample.radiance = lampRadiance(lamp, from);
    return sample;
}

double SceneLights::totalChoice(const Eigen::Vector3d& from) const {
    double sum = 0.0;
    for (const SceneLamp& lamp : rig_.scene_lamps) sum += choice(lamp, from);
    for (const Lamp& lamp : rig_.lamps) sum += choice(lamp, from);
    return sum;
}

std::optional<LightSample> SceneLights::sampleLamp(const Eigen::Vector3d& from, double which,
                                                   const std::array<double, 2>& where) const {
    const double total = totalChoice(from);
    if (total <= 0.0) return std::nullopt;
    double left = which * total;
    const Lamp* chosen = nullptr;
    for (const Lamp& lamp : rig_.lamps) {
        const double share = choice(lamp, from);
        if (share <= 0.0) continue;
        chosen = &lamp;
        left -= share;
        if (left < 0.0) break;
    }
    const SceneLamp* ball = nullptr;
    for (const SceneLamp& lamp : rig_.scene_lamps) {
        if (left < 0.0) break;
        const double share = choice(lamp, from);
        if (share <= 0.0) continue;
        ball = &lamp;
        left -= share;
    }
    if (ball != nullptr) return sampleBall(*ball, from, where);
    const double radius = chosen->radius_m * std::sqrt(where[0]);
    const double angle = 2.0 * kPi * where[1];
    const Eigen::Vector3d way =
        chosen->position +
        Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0.0) - from;
    LightSample sample;
    sample.distance = way.norm();
    sample.way = way / sample.distance;
    sample.free = std::max(sample.distance - kLampShade, 0.0);
    sample.density = choice(*chosen, from) / total * sample.distance * sample.distance /
                     (chosen->area() * sample.way.z());
    sample.radiance = lampRadiance(*chosen);
    return sample;
}

std::optional<LightSample> SceneLights::sampleTriangle(const Eigen::Vector3d& from, double which,
                                                       const std::array<double, 2>& where) const {
    if (power_.empty()) return std::nullopt;
    const auto found = std::upper_bound(power_.begin(), power_.end(), which * power_.back());
    const std::size_t index =
        std::min(found - power_.begin(), static_cast<std::ptrdiff_t>(power_.size()) - 1);
    const auto& [triangle, object_id] = emitters_[index];
    const auto [a, b, c] = surface_.corners(triangle);
    const double root = std::sqrt(where[0]);
    const double v = root * (1.0 - where[1]);
    const double w = root * where[1];
    const Eigen::Vector3d at = a + v * (b - a) + w * (c - a);
    LightSample sample;
    sample.distance = (at - from).norm();
    if (sample.distance <= 0.0) return std::nullopt;
    sample.way = (at - from) / sample.distance;
    sample.free = sample.distance;
    sample.density = triangleDensity(object_id, triangle, from, at);
    sample.radiance = sendsDaylight(scene_.object(object_id))
                          ? rig_.skyRadiance(sample.way)
                          : Eigen::Vector3f(rig_.emissionOf(surface_.emissionAt(triangle, v, w)) *
                                            shines_[object_id - 1]);
    if (!(sample.density > 0.0) || !std::isfinite(sample.density)) return std::nullopt;
    return sample;
}

double SceneLights::triangleDensity(int object_id, std::uint32_t triangle,
                                    const Eigen::Vector3d& from, const Eigen::Vector3d& at) const {
    if (power_.empty()) return 0.0;
    const auto [a, b, c] = surface_.corners(triangle);
    const Eigen::Vector3d across = (b - a).cross(c - a);
    const Eigen::Vector3d way = at - from;
    const double squared = way.squaredNorm();
    const double facing = std::abs(across.normalized().dot(way)) / std::sqrt(squared);
    return brightness(object_id, triangle) / power_.back() * squared / facing;
}

}  // namespace dollytrack::render
