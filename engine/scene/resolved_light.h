#pragma once

#include "engine/scene/light_params.h"

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace dollytrack {

/// The light that pictures are really made in: what was set, what the variation drew, and what
/// follows from both. Colours are linear. The default is the neutral light.
struct ResolvedLight {
    LightParams drawn;                // as set, but for what the variation changed
    double sun_elevation_deg = 45.0;  // below 0 it has set
    Eigen::Vector3d to_sun = {-0.5, -0.5, 0.70710678118654752};  // unit vector, world
    /// What falls on a surface that faces the sun, in units of a lamp's light at 1 m below it.
    Eigen::Vector3f sun_irradiance = Eigen::Vector3f::Zero();
    Eigen::Vector3f sky_factor = Eigen::Vector3f::Ones();  // times the neutral light's sky
    float lamp_factor = 1.0F;                              // times its lamps
    float own_lamps = 1.0F;                     // times the scene's own lamps, beside lamp_factor
    std::optional<Eigen::Vector3f> lamp_color;  // in the place of theirs
    /// Times the sky that cameras see where nothing else is.
    Eigen::Vector3f backdrop_factor = Eigen::Vector3f::Ones();
    float backdrop_grey = 0.0F;  // its colour is gone at 1, as behind clouds
    double exposure_ev = 0.0;
};

/// The same for the same parameters, whatever else happens.
[[nodiscard]] ResolvedLight resolved(const LightParams& params);

/// Whether frames have light of their own, see LightParams::light_varies.
[[nodiscard]] bool variesByFrame(const LightParams& params);

/// The light of a frame, by its number in the whole trajectory: the scene's, but for what varies by
/// frame. Each frame draws of its own around what is set.
[[nodiscard]] ResolvedLight resolvedAt(const LightParams& params, int trajectory_frame);

/// Height of the sun at the equinox at 45 degrees of latitude.
[[nodiscard]] double sunElevationDeg(double time_of_day_h);

/// Linear RGB of a black body, as bright as white (luminance 1); 1000 K and more. After Krystek's
/// approximation of its chromaticity (1985).
[[nodiscard]] Eigen::Vector3f blackBodyColor(double temperature_K);

/// What was drawn and what follows from it, for dataset.json.
[[nodiscard]] nlohmann::ordered_json toJson(const ResolvedLight& light);

}  // namespace dollytrack
