#include "render/formats/poses/calibration.h"

#include "engine/camera/intrinsics.h"
#include "render/sensors/sensor_lens.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <initializer_list>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 1> kCalibrationFiles = {"calibration.yaml"};

/// A mapping that OpenCV recognises as a matrix by its dt. OpenCV's tag is left out, because other
/// YAML readers refuse it.
std::string matrix(const char* name, int rows, int columns, std::initializer_list<double> values) {
    std::string text =
        fmt::format("{}:\n   rows: {}\n   cols: {}\n   dt: d\n", name, rows, columns);
    text += "   data: [";
    const char* before = "";
    for (const double value : values) {
        text += fmt::format("{} {:.12f}", before, value + 0.0);
        before = ",";
    }
    return text + " ]\n";
}

Result<std::vector<DatasetFile>> writeCalibration(const DatasetContents& contents) {
    const Intrinsics lens = makeIntrinsics(contents.camera);
    const bool of_sensor = contains(contents.modalities, kRgbSensor);
    const LensDistortion bent = of_sensor ? distortionOf(contents.sensor) : LensDistortion{};
    // Both readers put the first pixel's centre at (0, 0).
    const double cx = lens.cx - 0.5, cy = lens.cy - 0.5;
    std::string text = "%YAML 1.0\n---\n";
    text += fmt::format("image_width: {}\nimage_height: {}\ncamera_name: {}\n", lens.width,
                        lens.height, of_sensor ? "rgb_sensor" : "camera");
    text += matrix("camera_matrix", 3, 3, {lens.fx, 0, cx, 0, lens.fy, cy, 0, 0, 1});
    text += "distortion_model: plumb_bob\n";
    text += matrix("distortion_coefficients", 1, 5, {bent.k1, bent.k2, bent.p1, bent.p2, bent.k3});
    text += matrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    text += matrix("projection_matrix", 3, 4, {lens.fx, 0, cx, 0, 0, lens.fy, cy, 0, 0, 0, 1, 0});
    return std::vector<DatasetFile>{{kCalibrationFiles[0], text}};
}

nlohmann::ordered_json calibrationConvention(const DatasetContents& /*contents*/) {
    return {{"files", kCalibrationFiles},
            {"format",
             "OpenCV FileStorage and ROS camera_info: the camera of rgb_sensor if exported, "
             "otherwise that of rgb, without distortion; pixel centres have integer coordinates; "
             "undistorted images have the same camera_matrix as the clean ones"}};
}

}  // namespace

LensDistortion pictureDistortion(const DatasetContents& contents) {
    return contents.pictureModality().name == kRgbSensor ? distortionOf(contents.sensor)
                                                         : LensDistortion{};
}

const Format kCalibrationFormat = {
    .name = "calibration",
    .text = "the camera for OpenCV and ROS, with rgb_sensor's distortion, in calibration.yaml",
    .group = ContentGroup::Poses,
    .files = kCalibrationFiles,
    .write = writeCalibration,
    .convention = calibrationConvention,
};

}  // namespace dollytrack::render
