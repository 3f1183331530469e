#pragma once

#include "engine/scene/light_params.h"

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace dollytrack {

/// The light that images are rendered with: the settings, the values drawn by the random variation,
/// and values derived from both. Colours are linear. The default is the neutral light.
struct ResolvedLight {
    LightParams drawn;                // the settings, with varied values replaced
    double sun_elevation_deg = 45.0;  // below 0: below the horizon
    Eigen::Vector3d to_sun = {-0.5, -0.5, 0.70710678118654752};  // unit vector, world
    /// Irradiance of a surface that faces the sun, relative to that 1 m below a lamp.
    Eigen::Vector3f sun_irradiance = Eigen::Vector3f::Zero();
    Eigen::Vector3f sky_factor = Eigen::Vector3f::Ones();  // times the neutral light's sky
    float lamp_factor = 1.0F;                              // times the neutral light's lamps
    float own_lamps = 1.0F;  // times the lamps modelled in the scene, besides lamp_factor
    std::optional<Eigen::Vector3f> lamp_color;  // replaces the lamps' own colour
    /// Times the sky that cameras see as the background.
    Eigen::Vector3f backdrop_factor = Eigen::Vector3f::Ones();
    float backdrop_grey = 0.0F;  // desaturation of the background: 1 is grey, as behind clouds
    double exposure_ev = 0.0;
};

/// Computes the light of the scene. It depends on the parameters alone.
[[nodiscard]] ResolvedLight resolved(const LightParams& params);

/// Whether the light differs from frame to frame; see LightParams::light_varies.
[[nodiscard]] bool variesByFrame(const LightParams& params);

/// The light of a frame, given its index in the whole trajectory: that of the scene, except for the
/// values that vary by frame, which are drawn independently for each frame.
[[nodiscard]] ResolvedLight resolvedAt(const LightParams& params, int trajectory_frame);

/// Elevation of the sun at the equinox at 45 degrees of latitude.
[[nodiscard]] double sunElevationDeg(double time_of_day_h);

/// Linear RGB of a black body of at least 1000 K, scaled to the luminance of white. Chromaticity
/// after Krystek (1985).
[[nodiscard]] Eigen::Vector3f blackBodyColor(double temperature_K);

/// The light as dataset.json states it.
[[nodiscard]] nlohmann::ordered_json toJson(const ResolvedLight& light);

}  // namespace dollytrack
