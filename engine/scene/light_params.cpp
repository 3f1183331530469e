#include "engine/scene/light_params.h"

namespace dollytrack {

LightParams lightPreset(LightPreset preset) {
    LightParams params;
    params.light_preset = preset;
    switch (preset) {
        case LightPreset::Neutral:
            break;
        case LightPreset::Day:  // lamps on, so that rooms without windows have some light
            params.time_of_day_h = 14.0;
            params.sun_strength = 1.0;
            params.sky_strength = 2.5;
            params.lamp_strength = 0.15;
            params.exposure_ev = -0.3;
            break;
        case LightPreset::Evening:
            params.time_of_day_h = 17.0;
            params.sun_strength = 1.0;
            params.sky_strength = 2.0;
            params.lamp_strength = 0.6;
            params.lamp_temperature_K = 4000.0;
            params.exposure_ev = -0.3;
            break;
        case LightPreset::Night:
            params.time_of_day_h = 23.0;
            params.sky_strength = 0.0;
            params.lamp_temperature_K = 4000.0;
            params.exposure_ev = -0.8;
            break;
        case LightPreset::Overcast:
            params.sky_strength = 3.0;
            params.lamp_strength = 0.3;
            params.exposure_ev = -0.2;
            break;
    }
    return params;
}

void letLightPresetSetOthers(FieldList& fields, LightParams& params) {
    letPresetSetOthers(fields, "light_preset", [&params] {
        LightParams chosen = lightPreset(params.light_preset);
        chosen.sun_azimuth_deg = params.sun_azimuth_deg;
        chosen.light_variation = params.light_variation;
        chosen.light_varies = params.light_varies;
        chosen.light_seed = params.light_seed;
        params = chosen;
    });
}

FieldList listLightFields(LightParams& params) {
    FieldCollector collector;
    collector.beginSection("light");
    visitLightParams(params, collector);
    FieldList fields = collector.take();
    letLightPresetSetOthers(fields, params);
    return fields;
}

}  // namespace dollytrack
