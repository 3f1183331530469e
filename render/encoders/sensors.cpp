#include "engine/io/files/jpeg_writer.h"
#include "engine/io/files/png_writer.h"
#include "render/dataset/contents/modality.h"
#include "render/encoders/encoders.h"
#include "render/encoders/pack.h"
#include "render/sensors/depth_noise.h"
#include "render/sensors/exposure.h"
#include "render/sensors/picture_noise.h"
#include "render/sensors/sensor_lens.h"

#include <nlohmann/json.hpp>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

FrameFiles encodeRgbSensor(const FrameContext& context, const FrameRecord& frame) {
    const SensorParams& params = context.contents.sensor;
    std::vector<float> light = context.sensor_lens->take(frame.sensor_light);
    addPictureNoise(params, context.contents.sourceFrame(frame.index), light);
    const std::vector<std::uint8_t> rgb = developedBytes(light);
    return oneFile(frameFile("rgb_sensor", frame.index, pictureEnding(params)),
                   params.jpeg_quality < 100
                       ? encodeJpeg(frame.width, frame.height, 3, params.jpeg_quality, rgb)
                       : encodePng(frame.width, frame.height, PngFormat::Rgb8, rgb));
}

FrameFiles encodeDepthSensor(const FrameContext& context, const FrameRecord& frame) {
    const DepthNoiseInput input = {context.contents.sourceFrame(frame.index),
                                   makeIntrinsics(context.contents.camera),
                                   frame.pose.rotation,
                                   frame.depth_m,
                                   frame.normals_in_world,
                                   frame.albedo};
    return oneFile(
        frameFile("depth_sensor", frame.index),
        encodePng(frame.width, frame.height, PngFormat::Gray16,
                  bytesOf(depthInMillimetres(noisyDepth(context.contents.sensor, input)))));
}

Json rgbSensorConvention(const DatasetContents& contents) {
    const SensorParams& params = contents.sensor;
    return {
        {"folder", "rgb_sensor"},
        {"ending", pictureEnding(params)},
        {"type", "uint8 x 3"},
        {"encoding", "sRGB, with the tone curve of the clean images"},
        {"meaning",
         "image of the simulated camera sensor; pose, depth and labels of the frame have no blur "
         "and distortion and are at its time_s"},
        {"distortion",
         {{"model", "opencv"},
          {"k1", params.k1},
          {"k2", params.k2},
          {"p1", params.p1},
          {"p2", params.p2},
          {"k3", params.k3},
          {"intrinsics",
           "fx fy cx cy of conventions.intrinsics; for OpenCV, whose pixel centres have integer "
           "coordinates, subtract 0.5 from cx and cy"}}},
        {"exposure",
         {{"shutter_s", params.shutter_s},
          {"readout_s", params.readout_s},
          {"looks", params.looks},
          {"row_exposure_s", rowExposureSeconds(params, contents.camera.height_px)},
          {"row_time",
           "time_s + readout_s * (row / (height - 1) - 0.5), the middle of that row's exposure"},
          {"motion",
           "C2 spline through the trajectory's poses; moving objects have constant linear and "
           "angular velocity between frames"}}},
        {"lens",
         {{"aperture_mm", params.aperture_mm},
          {"focus_m", params.focus_m},
          {"focus",
           "0: median depth of the targets in the middle half of the image, or of all its pixels "
           "if it shows no targets"},
          {"vignetting", params.vignetting},
          {"vignetting_law", "1 - vignetting * (1 - cos^4 of the angle off axis)"}}},
        {"noise",
         {{"white_e", params.white_e},
          {"read_noise_e", params.read_noise_e},
          {"law",
           "in linear light with white = 1: variance = light / white_e + (read_noise_e / "
           "white_e)^2; white_e = 0: no noise"},
          {"sensor_seed", params.sensor_seed}}},
        {"jpeg_quality", params.jpeg_quality}};
}

Json depthSensorConvention(const DatasetContents& contents) {
    SensorParams params = contents.sensor;
    std::string model;
    for (const Field& field : listSensorFields(params)) {
        if (field.name == "depth_noise") model = field.valueText();
    }
    const DepthLimits limits = depthLimits(params.depth_noise);
    return {{"folder", "depth_sensor"},
            {"type", "uint16"},
            {"kind", "planar"},
            {"scale_m", 0.001},
            {"invalid", 0},
            {"meaning",
             "distance along the viewing axis, with the errors of the simulated depth camera; "
             "undistorted, all pixels at the frame's time"},
            {"model", model},
            {"strength", params.depth_noise_strength},
            {"nearest_m", limits.nearest_m},
            {"farthest_m", limits.farthest_m},
            {"sensor_seed", params.sensor_seed}};
}

}  // namespace dollytrack::render
