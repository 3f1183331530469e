#include "engine/scene/resolved_light.h"

#include "engine/core/random.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

/// Sunlight above the atmosphere, in units of a lamp's light at 1 m below it. Far less than the
/// real sun's, so that images can show both sunlight and the rooms' light.
constexpr float kSunAboveAir = 16.0F;

/// Approximate colour temperature of the neutral light's lamps; the variation is around it.
constexpr double kUsualLamp_K = 5500.0;
constexpr double kWarmest_K = 1000.0;

double within(double value, double low, double high) {
    return std::clamp(value, low, high);
}

/// A random offset within +-`most`, scaled by light_variation. `frame`: 0 for values of the scene,
/// otherwise the frame's number + 1.
double spreadOf(const LightParams& set, std::uint64_t frame, std::uint64_t stream, double most) {
    // Each field has its own stream, so that adding or removing a field does not change the others.
    Random random(static_cast<std::uint64_t>(set.light_seed), 16 * frame + stream);
    return random.uniform(-most, most) * set.light_variation;
}

void varySun(const LightParams& set, LightParams& drawn) {
    drawn.time_of_day_h = within(set.time_of_day_h + spreadOf(set, 0, 1, 2.5), 0.0, 24.0);
    drawn.sun_azimuth_deg = within(set.sun_azimuth_deg + spreadOf(set, 0, 2, 40.0), -360.0, 360.0);
}

void varyStrengths(const LightParams& set, std::uint64_t frame, LightParams& drawn) {
    const auto spread = [&](std::uint64_t stream, double most) {
        return spreadOf(set, frame, stream, most);
    };
    drawn.sun_strength = within(set.sun_strength * std::exp2(spread(3, 0.7)), 0.0, 10.0);
    drawn.sky_strength = within(set.sky_strength * std::exp2(spread(4, 0.7)), 0.0, 20.0);
    drawn.lamp_strength = within(set.lamp_strength * std::exp2(spread(5, 1.0)), 0.0, 10.0);
    const double usual = set.lamp_temperature_K > 0.0 ? set.lamp_temperature_K : kUsualLamp_K;
    drawn.lamp_temperature_K = within(usual * std::exp2(spread(6, 0.5)), kWarmest_K, 20000.0);
    drawn.exposure_ev = within(set.exposure_ev + spread(7, 0.7), -10.0, 10.0);
}

/// Transmittance of the atmosphere for red, green and blue: Rayleigh and aerosol optical depths at
/// 610, 550 and 465 nm (Angstrom turbidity 0.05), with the air mass of Kasten (1965).
Eigen::Vector3f throughAir(double elevation_deg) {
    if (elevation_deg <= 0.0) return Eigen::Vector3f::Zero();
    const double mass =
        1.0 / (std::sin(elevation_deg * kRadians) + 0.15 * std::pow(elevation_deg + 3.885, -1.253));
    const Eigen::Vector3d depth(0.159, 0.206, 0.325);
    return (-mass * depth.array()).exp().cast<float>();
}

/// Colour and strength of the sky relative to noon; exactly 1 from an elevation of 20 degrees.
Eigen::Vector3f skyAt(double elevation_deg) {
    const double t = std::clamp((elevation_deg + 8.0) / 28.0, 0.0, 1.0);
    const double bright = t * t * (3.0 - 2.0 * t);
    const double low = std::clamp(1.0 - std::abs(elevation_deg - 2.0) / 12.0, 0.0, 1.0);
    const Eigen::Vector3d red(0.45, -0.08, -0.30);  // tint at a low sun
    const Eigen::Vector3d tint = Eigen::Vector3d::Ones() + low * low * (3.0 - 2.0 * low) * red;
    return (bright * tint).cast<float>();
}

nlohmann::ordered_json list(const Eigen::Vector3f& color) {
    return {color.x(), color.y(), color.z()};
}

}  // namespace

double sunElevationDeg(double time_of_day_h) {
    const double hour_angle = (time_of_day_h - 12.0) * 15.0 * kRadians;
    return std::asin(std::sqrt(0.5) * std::cos(hour_angle)) / kRadians;
}

Eigen::Vector3f blackBodyColor(double temperature_K) {
    const double t = std::clamp(temperature_K, kWarmest_K, 20000.0);
    const double u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                     (1.0 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
    const double v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                     (1.0 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
    const double x = 3.0 * u / (2.0 * u - 8.0 * v + 4.0);
    const double y = 2.0 * v / (2.0 * u - 8.0 * v + 4.0);
    const Eigen::Vector3d xyz(x / y, 1.0, (1.0 - x - y) / y);
    Eigen::Matrix3d rgb_from_xyz;  // IEC 61966-2-1
    rgb_from_xyz << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
    return (rgb_from_xyz * xyz).cwiseMax(0.0).cast<float>();
}

namespace {

ResolvedLight lightOf(const LightParams& params) {
    ResolvedLight light;
    light.drawn = params;
    const LightParams& drawn = light.drawn;
    light.sun_elevation_deg = sunElevationDeg(drawn.time_of_day_h);
    const double height = light.sun_elevation_deg * kRadians;
    const double around = drawn.sun_azimuth_deg * kRadians;
    light.to_sun = {std::cos(height) * std::cos(around), std::cos(height) * std::sin(around),
                    std::sin(height)};
    light.sun_irradiance = throughAir(light.sun_elevation_deg) *
                           (kSunAboveAir * static_cast<float>(drawn.sun_strength));
    Eigen::Vector3f sky = skyAt(light.sun_elevation_deg);
    light.backdrop_factor = sky * static_cast<float>(std::min(drawn.sky_strength, 1.0));
    if (drawn.light_preset == LightPreset::Overcast) {
        light.backdrop_grey = 0.85F;  // a factor would colour the grey ground brown
        sky = sky.cwiseProduct(Eigen::Vector3f(1.16F, 1.0F, 0.84F));  // grey instead of blue
    }
    light.sky_factor = sky * static_cast<float>(drawn.sky_strength);
    light.lamp_factor = static_cast<float>(drawn.lamp_strength);
    light.own_lamps = static_cast<float>(drawn.own_lamps);
    if (drawn.lamp_temperature_K > 0.0) {
        constexpr float kUsualLuminance = 0.937F;  // luminance of the neutral light's lamps
        light.drawn.lamp_temperature_K = std::max(drawn.lamp_temperature_K, kWarmest_K);
        light.lamp_color = kUsualLuminance * blackBodyColor(drawn.lamp_temperature_K);
    }
    light.exposure_ev = drawn.exposure_ev;
    return light;
}

}  // namespace

bool variesByFrame(const LightParams& params) {
    return params.light_varies == LightVaries::Frame && params.light_variation > 0.0;
}

ResolvedLight resolved(const LightParams& params) {
    LightParams drawn = params;
    if (params.light_variation > 0.0) {
        varySun(params, drawn);
        if (!variesByFrame(params)) varyStrengths(params, 0, drawn);
    }
    return lightOf(drawn);
}

ResolvedLight resolvedAt(const LightParams& params, int trajectory_frame) {
    if (!variesByFrame(params)) return resolved(params);
    LightParams drawn = params;
    varySun(params, drawn);
    varyStrengths(params, static_cast<std::uint64_t>(trajectory_frame) + 1, drawn);
    return lightOf(drawn);
}

nlohmann::ordered_json toJson(const ResolvedLight& light) {
    nlohmann::ordered_json json;
    LightParams drawn = light.drawn;
    for (const Field& field : listLightFields(drawn)) {
        if (field.name == "light_variation" || field.name == "light_seed") continue;
        if (const auto* real = std::get_if<Field::Real>(&field.value)) {
            json[field.name] = *real->value;
        } else {
            json[field.name] = field.valueText();
        }
    }
    json["sun_elevation_deg"] = light.sun_elevation_deg;
    json["to_sun"] = {light.to_sun.x(), light.to_sun.y(), light.to_sun.z()};
    json["sun_irradiance"] = list(light.sun_irradiance);
    json["sky_factor"] = list(light.sky_factor);
    json["lamp_factor"] = light.lamp_factor;
    if (light.lamp_color) json["lamp_color"] = list(*light.lamp_color);
    return json;
}

}  // namespace dollytrack
