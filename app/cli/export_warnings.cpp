#include "app/cli/export_warnings.h"

#include "engine/core/log.h"
#include "render/formats/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace dollytrack::cli {
namespace {

void warnOfLight(const LightParams& light, const render::DatasetSettings& settings) {
    if (light.light_varies != LightVaries::Frame) return;
    if (light.light_variation == 0.0) {
        log::warn("export",
                  "light_varies=frame changes nothing while light_variation is 0: set that too, up "
                  "to 1");
        return;
    }
    const auto formats = render::chooseFormats(settings.formats);
    const bool recorded = formats && std::ranges::any_of(*formats, [](const render::Format* one) {
                              return std::string_view(one->name) == "frames";
                          });
    if (recorded) return;
    log::warn("export",
              "light_varies=frame: what light each frame has is not recorded; add frames to "
              "--formats");
}

/// Of the same place, direction and lens: its images are those of the dataset.
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
    for (const RigCamera& camera : settings.rig) {
        if (!repeats(camera, params.camera)) continue;
        log::warn("export",
                  fmt::format("camera '{}' is the planned camera once more: same place, direction "
                              "and lens; give it others, as in {}:yaw_deg=90",
                              camera.name, camera.name));
    }
}

}  // namespace dollytrack::cli
