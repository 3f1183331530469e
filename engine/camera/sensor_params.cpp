#include "engine/camera/sensor_params.h"

namespace dollytrack {

SensorParams sensorPreset(SensorPreset preset) {
    SensorParams params;
    params.sensor_preset = preset;
    if (preset == SensorPreset::Phone) return params;
    params.shutter_s = params.readout_s = 0.0;
    params.k1 = params.k2 = params.k3 = params.vignetting = 0.0;
    params.white_e = params.read_noise_e = 0.0;
    switch (preset) {
        case SensorPreset::Ideal:
        case SensorPreset::Phone:
            break;
        case SensorPreset::Webcam:
            params.shutter_s = 1.0 / 30.0;
            params.readout_s = 0.028;
            params.k1 = -0.08;
            params.k2 = 0.03;
            params.vignetting = 0.6;
            params.white_e = 1500.0;
            params.read_noise_e = 6.0;
            params.jpeg_quality = 75;
            break;
        case SensorPreset::ActionCamera:
            params.shutter_s = 1.0 / 120.0;
            params.readout_s = 0.012;
            params.k1 = -0.26;
            params.k2 = 0.09;
            params.vignetting = 0.8;
            params.white_e = 4000.0;
            params.read_noise_e = 4.0;
            params.jpeg_quality = 90;
            break;
        case SensorPreset::MachineVision:  // global shutter, a 6 mm lens at f/2
            params.shutter_s = 0.005;
            params.aperture_mm = 3.0;
            params.k1 = -0.10;
            params.k2 = 0.08;
            params.p1 = 0.0004;
            params.p2 = -0.0003;
            params.vignetting = 0.3;
            params.white_e = 10000.0;
            params.read_noise_e = 7.0;
            break;
    }
    return params;
}

void letSensorPresetSetOthers(FieldList& fields, SensorParams& params) {
    letPresetSetOthers(fields, "sensor_preset", [&params] {
        SensorParams chosen = sensorPreset(params.sensor_preset);
        chosen.depth_noise = params.depth_noise;
        chosen.depth_noise_strength = params.depth_noise_strength;
        chosen.looks = params.looks;
        chosen.focus_m = params.focus_m;
        chosen.sensor_seed = params.sensor_seed;
        params = chosen;
    });
}

FieldList listSensorFields(SensorParams& params) {
    FieldCollector collector;
    collector.beginSection("sensor");
    visitSensorParams(params, collector);
    FieldList fields = collector.take();
    letSensorPresetSetOthers(fields, params);
    return fields;
}

}  // namespace dollytrack
