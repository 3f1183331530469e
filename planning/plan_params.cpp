#include "planning/plan_params.h"

#include "engine/camera/intrinsics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace dollytrack::planning {

std::vector<std::pair<std::string, std::string>> changedFields(PlanParams a, PlanParams b) {
    const FieldList fields_a = listFields(a);
    const FieldList fields_b = listFields(b);
    std::vector<std::pair<std::string, std::string>> changed;
    for (std::size_t i = 0; i < fields_a.size(); ++i) {
        std::string value = fields_b[i].valueText();
        if (fields_a[i].valueText() == value) continue;
        changed.emplace_back(fields_b[i].name, std::move(value));
    }
    return changed;
}

FieldList listFields(PlanParams& params) {
    FieldCollector collector;
    visitPlanParams(
        params, [&](std::string_view section) { collector.beginSection(section); }, collector);
    FieldList fields = collector.take();
    letSensorPresetSetOthers(fields, params.sensor);
    letLightPresetSetOthers(fields, params.light);
    letPresetSetOthers(fields, "camera_preset", [&params] { applyCameraPreset(params); });
    return fields;
}

void applyCameraPreset(PlanParams& params) {
    const PlanParams defaults;
    const CameraPreset preset = params.body.camera_preset;
    params.body = defaults.body;
    params.body.camera_preset = preset;
    params.camera.camera_radius_m = defaults.camera.camera_radius_m;
    params.free_space.min_height_m = defaults.free_space.min_height_m;
    params.free_space.max_height_m = defaults.free_space.max_height_m;
    params.constraints.min_pitch_deg = defaults.constraints.min_pitch_deg;
    params.constraints.max_pitch_deg = defaults.constraints.max_pitch_deg;
    params.shake.shake = defaults.shake.shake;
    switch (preset) {
        case CameraPreset::Free:
            break;
        case CameraPreset::Handheld:  // between a lowered hand and a raised arm
            params.free_space.min_height_m = 0.9;
            params.free_space.max_height_m = 1.9;
            params.constraints.min_pitch_deg = -60.0;
            params.constraints.max_pitch_deg = 45.0;
            params.shake.shake = ShakeKind::Handheld;
            break;
        case CameraPreset::Drone:  // a small drone with propeller guards and its camera on a gimbal
            params.camera.camera_radius_m = 0.2;
            params.free_space.min_height_m = 0.4;
            params.constraints.min_pitch_deg = -85.0;
            params.constraints.max_pitch_deg = 30.0;
            break;
        case CameraPreset::Robot:
            params.body.camera_height_m = 0.4;
            params.body.body = BodyShape::Cylinder;
            params.body.heading = Heading::Along;
            params.constraints.min_pitch_deg = 0.0;
            params.constraints.max_pitch_deg = 0.0;
            break;
    }
}

double sharpWithin_m(const PlanParams& params) {
    return 1e-3 * params.coverage.surface_mm_px * makeIntrinsics(params.camera).fx;
}

Status validate(const PlanParams& params) {
    if (Status status = validate(params.camera); !status) return status;
    const FreeSpaceParams& band = params.free_space;
    const BodyParams& body = params.body;
    if (!(band.min_height_m < band.max_height_m)) {
        return fail(ErrorCode::Usage, "max_height_m must be above min_height_m.", "max_height_m");
    }
    if (params.constraints.min_pitch_deg > params.constraints.max_pitch_deg) {
        return fail(ErrorCode::Usage, "max_pitch_deg must not be below min_pitch_deg.",
                    "max_pitch_deg");
    }
    const bool has_height = body.camera_height_m > 0.0;
    if (has_height &&
        (body.camera_height_m < band.min_height_m || body.camera_height_m > band.max_height_m)) {
        return fail(ErrorCode::Usage,
                    "The camera's height must lie between min_height_m and max_height_m.",
                    "camera_height_m");
    }
    if (body.body == BodyShape::Cylinder && !has_height) {
        return fail(ErrorCode::Usage,
                    "body=cylinder stands on the floor and needs camera_height_m above 0.", "body");
    }
    if (body.body == BodyShape::Cylinder && body.body_height_m <= body.max_step_m) {
        return fail(ErrorCode::Usage, "The cylinder's top must be above max_step_m.",
                    "body_height_m");
    }
    if (asksForSurface(params)) {
        const double sharp_m = sharpWithin_m(params);
        if (sharp_m <= params.camera.camera_radius_m) {
            return fail(ErrorCode::Usage,
                        fmt::format("A pixel is {:g} mm wide at {:.2f} m, nearer than "
                                    "camera_radius_m lets the camera come; raise surface_mm_px or "
                                    "the resolution.",
                                    params.coverage.surface_mm_px, sharp_m),
                        "surface_mm_px");
        }
    }
    if (body.heading == Heading::Along && params.shake.shake != ShakeKind::None) {
        return fail(ErrorCode::Usage,
                    "A shaken camera does not look along its motion; set shake=none or "
                    "heading=free.",
                    "heading");
    }
    return {};
}

// This list and the next function name the same sections.
bool affectsOnlyImages(std::string_view section) {
    constexpr std::array<std::string_view, 5> kSections = {"imu", "stereo", "picture", "light",
                                                           "sensor"};
    return std::ranges::find(kSections, section) != kSections.end();
}

PlanParams onlyOfThePlan(PlanParams params) {
    params.imu = {};
    params.stereo = {};
    params.picture = {};
    params.sensor = {};
    params.light = {};
    return params;
}

bool makeSamePlan(const PlanParams& a, const PlanParams& b) {
    return onlyOfThePlan(a) == onlyOfThePlan(b);
}

Status setParameter(nlohmann::json& sections, const std::string& name,
                    const nlohmann::json& value) {
    PlanParams params;
    const FieldList fields = listFields(params);
    return setFromJson(fields, sections)
        .and_then([&] {
            return setFromJson(fields, {{"parameters", {{name, value}}}});
        })
        .map([&] { sections = toJson(fields); });
}

}  // namespace dollytrack::planning
