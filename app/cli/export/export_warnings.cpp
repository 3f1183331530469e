#include "app/cli/export/export_warnings.h"

#include "app/cli/scene_arguments.h"
#include "engine/core/field_list.h"
#include "engine/core/log.h"
#include "engine/scene/resolved_light.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace dollytrack::cli {
namespace {

void warnOfLight(const LightParams& light, const render::DatasetSettings& settings) {
    if (light.light_varies != LightVaries::Frame || light.light_variation == 0.0) return;
    const auto formats = render::chooseFormats(settings.formats);
    const bool recorded = formats && std::ranges::any_of(*formats, [](const render::Format* one) {
                              return std::string_view(one->name) == "frames";
                          });
    if (recorded) return;
    log::warn(
        "export",
        "light_varies=frame: the light of each frame is not recorded; add frames to --formats");
}

void warnOfSun(const LightParams& light) {
    const LightParams standard;
    const bool set_strength = light.sun_strength > 0.0;
    if (!set_strength && light.sun_azimuth_deg == standard.sun_azimuth_deg) return;
    // Light variation may draw another time of day.
    if (sunElevationDeg(light.time_of_day_h) > 0.0 || resolved(light).sun_elevation_deg > 0.0) {
        return;
    }
    log::warn(
        "export",
        fmt::format(
            "{} has no effect with the sun below the horizon; set time_of_day_h between 6 and 18",
            set_strength ? "sun_strength" : "sun_azimuth_deg"));
}

void warnOfParametersWithoutEffect(planning::PlanParams params) {
    planning::PlanParams defaults;
    const FieldList fields = planning::listFields(params);
    const FieldList standard = planning::listFields(defaults);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const Field& field = fields[i];
        if (!planning::affectsOnlyImages(field.section) ||
            field.valueText() == standard[i].valueText())
            continue;
        const std::string message = noEffectMessage(fields, field);
        if (!message.empty()) log::warn("export", message);
    }
}

/// Warns of blur settings without exposure samples; a rolling shutter always has several samples.
void warnOfMissingSamples(const SensorParams& sensor, const render::DatasetSettings& settings) {
    const bool blurs = sensor.shutter_s > 0.0 || sensor.aperture_mm > 0.0;
    if (sensor.looks > 1 || sensor.readout_s > 0.0 || !blurs) return;
    const auto chosen =
        render::chooseModalities(settings.modalities, {!settings.rig.empty(), true});
    if (!chosen || !render::contains(*chosen, render::kRgbSensor)) return;
    log::warn("export",
              fmt::format("{} has no effect with one exposure sample (looks=1); set looks=16",
                          sensor.shutter_s > 0.0 ? "shutter_s" : "aperture_mm"));
}

/// Whether a rig camera has the pose and lens of the planned camera, so that its images would be
/// the same.
bool repeats(const RigCamera& camera, const CameraParams& planned) {
    const Pose place = carrierFromCamera(camera);
    return camera.lens == Lens::Pinhole && !camera.level && place.position.norm() < 1e-9 &&
           place.rotation.angularDistance(Eigen::Quaterniond::Identity()) < 1e-9 &&
           camera.width_px == planned.width_px && camera.height_px == planned.height_px &&
           camera.fov_deg == planned.hfov_deg;
}

}  // namespace

void warnOfExport(const planning::PlanParams& params, const render::DatasetSettings& settings) {
    warnOfLight(params.light, settings);
    warnOfSun(params.light);
    warnOfParametersWithoutEffect(params);
    warnOfMissingSamples(params.sensor, settings);
    for (const RigCamera& camera : settings.rig) {
        if (!repeats(camera, params.camera)) continue;
        log::warn("export", fmt::format("camera '{}' duplicates the planned camera's pose and "
                                        "lens; change one, as in {}:yaw_deg=90",
                                        camera.name, camera.name));
    }
}

}  // namespace dollytrack::cli
