#pragma once

#include "engine/core/field_list.h"

namespace dollytrack {

/// Sets of settings that belong together. Typical of the kind, measured on no single camera. Their
/// distortion is that of an image 60 degrees wide; in wider ones render/sensors/sensor_lens fits
/// it.
enum class SensorPreset { Ideal, Phone, Webcam, ActionCamera, MachineVision };

/// How the depth camera errs; the models and their sources are in render/sensors/depth_noise.h.
enum class DepthNoise { None, KinectAzure, Redwood };

/// Simulation of a real camera's images from the clean ones: the modalities rgb_sensor and
/// depth_sensor; all other files are the same. The values here are those of a phone.
struct SensorParams {
    SensorPreset sensor_preset = SensorPreset::Phone;
    double shutter_s = 1.0 / 60.0;
    double readout_s = 0.015;
    int looks = 16;
    double aperture_mm = 0.0;
    double focus_m = 0.0;
    double k1 = 0.05;
    double k2 = -0.08;
    double p1 = 0.0;
    double p2 = 0.0;
    double k3 = 0.02;
    double vignetting = 0.4;
    double white_e = 6000.0;
    double read_noise_e = 4.0;
    int jpeg_quality = 100;
    DepthNoise depth_noise = DepthNoise::KinectAzure;
    double depth_noise_strength = 1.0;
    int sensor_seed = 1;

    bool operator==(const SensorParams&) const = default;
};

template <class Params, class Visitor>
void visitSensorParams(Params& p, Visitor&& visit) {
    visit("sensor_preset", p.sensor_preset,
          ChoiceInfo{{"ideal", "phone", "webcam", "action_camera", "machine_vision"},
                     "Model of the colour camera: sets shutter, lens, noise and quality; "
                     "parameters set explicitly override it"});
    visit("shutter_s", p.shutter_s,
          FieldInfo{0, 1, "s", "Exposure time of each row, which blurs motion"});
    visit("readout_s", p.readout_s,
          FieldInfo{0, 1, "s",
                    "Rolling shutter: time from the first row's exposure to the last row's; the "
                    "frame's time is the middle"});
    visit("looks", p.looks,
          FieldInfo{1, 1024, "",
                    "Exposure samples averaged over shutter and aperture; a blur of more pixels "
                    "than this shows steps"});
    visit(
        "aperture_mm", p.aperture_mm,
        FieldInfo{
            0, 100, "mm",
            "Diameter of the aperture (focal length / f-number); 0: a pinhole, sharp everywhere"});
    visit("focus_m", p.focus_m,
          FieldInfo{0, 1000, "m",
                    "Depth in focus; 0: that of the objects at the centre of each frame"}
              .onlyWith("aperture_mm>0"));
    visit("k1", p.k1, FieldInfo{-2, 2, "", "Radial distortion, r^2 (OpenCV's model)"});
    visit("k2", p.k2, FieldInfo{-2, 2, "", "Radial distortion, r^4"});
    visit("p1", p.p1, FieldInfo{-0.5, 0.5, "", "Tangential distortion"});
    visit("p2", p.p2, FieldInfo{-0.5, 0.5, "", "Tangential distortion"});
    visit("k3", p.k3, FieldInfo{-2, 2, "", "Radial distortion, r^6"});
    visit(
        "vignetting", p.vignetting,
        FieldInfo{
            0, 1, "",
            "Darkening towards the corners; 1: cos^4 of the angle off axis, as in a simple lens"});
    visit("white_e", p.white_e,
          FieldInfo{0, 1e6, "e-",
                    "Electrons collected from a white surface, which determine shot noise: fewer "
                    "is a higher ISO; 0: no shot or read noise"});
    visit("read_noise_e", p.read_noise_e,
          FieldInfo{0, 1000, "e-", "Standard deviation of the read noise"});
    visit("jpeg_quality", p.jpeg_quality,
          FieldInfo{1, 100, "", "Quality of JPEG files; 100: PNG files instead"});
    visit("depth_noise", p.depth_noise,
          ChoiceInfo{{"none", "kinect_azure", "redwood"},
                     "Errors of the depth camera: none, those of time of flight (kinect_azure) or "
                     "of structured light (redwood)"});
    visit("depth_noise_strength", p.depth_noise_strength,
          FieldInfo{0, 10, "",
                    "Scale factor of the standard deviation and lateral jitter of depth_noise; "
                    "holes do not change"}
              .onlyWith("depth_noise=kinect_azure|redwood"));
    visit("sensor_seed", p.sensor_seed, FieldInfo{0, 2e9, "", "Random seed of the sensor noise"});
}

/// File extension of the sensor's images.
[[nodiscard]] inline const char* pictureEnding(const SensorParams& params) {
    return params.jpeg_quality < 100 ? ".jpg" : ".png";
}

/// The values of a preset; what it does not set (looks, focus, depth camera, seed) is as by
/// default.
[[nodiscard]] SensorParams sensorPreset(SensorPreset preset);

/// Makes the field sensor_preset of the list, when it is set, also set all values of the preset in
/// `params`.
void letSensorPresetSetOthers(FieldList& fields, SensorParams& params);

/// The fields, for files. Points into `params`.
[[nodiscard]] FieldList listSensorFields(SensorParams& params);

}  // namespace dollytrack
