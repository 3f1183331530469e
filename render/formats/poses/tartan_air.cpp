#include "render/formats/poses/tartan_air.h"

#include "engine/io/files/png_writer.h"
#include "render/dataset/contents/frame_context.h"
#include "render/encoders/numpy_file.h"
#include "render/encoders/pack.h"
#include "render/formats/poses/frame_text.h"
#include "render/truth/motion_field.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 2> kTartanAirFiles = {"pose_left.txt", "pose_right.txt"};

constexpr std::array<const char*, 4> kTartanAirFolders = {"image_left", "depth_left", "seg_left",
                                                          "flow"};
constexpr float kSkyDepth = 10'000.0F;  // where nothing is hit

/// One pose per line, for a camera shifted to the right.
std::string poseLines(const DatasetContents& contents, double right_m) {
    // North is the world's x, east is -y, and down is -z.
    const Eigen::Vector3d ned_from_world(1, -1, -1);
    // The body axes are forward, right, down.
    Eigen::Matrix3d body_from_camera;
    body_from_camera << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    std::string poses;
    for (const DatasetFrame& frame : contents.frames) {
        const Pose& pose = frame.camera.pose;
        const Eigen::Quaterniond rotation(
            Eigen::Matrix3d(ned_from_world.asDiagonal() * pose.rotation.toRotationMatrix() *
                            body_from_camera.transpose()));
        const Eigen::Vector3d position = pose.toWorld({right_m, 0.0, 0.0});
        poses += positionQuaternionText(ned_from_world.cwiseProduct(position), rotation);
        poses += '\n';
    }
    return poses;
}

Result<std::vector<DatasetFile>> writeTartanAir(const DatasetContents& contents) {
    return std::vector<DatasetFile>{
        {kTartanAirFiles[0], poseLines(contents, 0.0)},
        {kTartanAirFiles[1], poseLines(contents, contents.stereo_baseline_m)}};
}

/// TartanAir's mask values, 10: occluded, 100: outside the image.
std::uint8_t maskOf(PixelVisibility sight) {
    switch (sight) {
        case PixelVisibility::Seen:
            return 0;
        case PixelVisibility::Occluded:
            return 10;
        default:
            return 100;
    }
}

Result<std::vector<FrameFile>> encodeTartanAir(const FrameContext& context,
                                               const FrameRecord& frame) {
    const int width = frame.width;
    const int height = frame.height;
    auto image = encodePng(width, height, PngFormat::Rgb8, frame.rgb);
    if (!image) return tl::unexpected(std::move(image.error()));
    std::vector<float> depth = frame.depth_m;
    std::replace(depth.begin(), depth.end(), 0.0F, kSkyDepth);
    const Scene& scene = context.contents.scene;
    const auto classes = classBytes(scene.classes(), classesOf(scene, frame.instance));
    std::vector<FrameFile> files;
    files.push_back({frameFile(kTartanAirFolders[0], frame.index, "_left.png"), std::move(*image)});
    files.push_back({frameFile(kTartanAirFolders[1], frame.index, "_left_depth.npy"),
                     numpyBytes("<f4", {height, width}, bytesOf(depth))});
    files.push_back(
        {frameFile(kTartanAirFolders[2], frame.index, "_left_seg.npy"),
         numpyBytes(scene.classes().isWide() ? "<u2" : "|u1", {height, width}, classes)});
    const int next = frame.index + 1;
    if (next < static_cast<int>(context.contents.frames.size())) {
        const MotionField field = motionField(context, frame, next);
        std::vector<float> flow;
        for (const Eigen::Vector2f& motion : field.motion) {
            flow.insert(flow.end(), {motion.x(), motion.y()});
        }
        std::vector<std::uint8_t> mask;
        for (const PixelVisibility sight : field.sight) mask.push_back(maskOf(sight));
        files.push_back({pairFile(kTartanAirFolders[3], frame.index, next, "_flow.npy"),
                         numpyBytes("<f4", {height, width, 2}, bytesOf(flow))});
        files.push_back({pairFile(kTartanAirFolders[3], frame.index, next, "_mask.npy"),
                         numpyBytes("|u1", {height, width}, bytesOf(mask))});
    }
    return files;
}

nlohmann::ordered_json tartanAirConvention(const DatasetContents& contents) {
    const std::string classes = contents.scene.classes().isNyu40() ? "NYU40" : "id in classes";
    return {
        {"files", kTartanAirFiles},
        {"folders", kTartanAirFolders},
        {"format",
         "TartanAir: one line per frame with position and quaternion (x y z w) of the camera in "
         "the world, axes x north (the world's x), y east, z down; the camera's x is forward; "
         "depth_left: float32, planar metres, 10000 where no surface is visible; flow: float32 u, "
         "v to the next frame, its mask 0 visible, 10 occluded, 100 outside the image"},
        {"seg_left", classes}};
}

}  // namespace

const Format kTartanAirFormat = {
    .name = "tartanair",
    .text = "poses, images, depth and flow in TartanAir's format, in pose_left.txt, image_left ...",
    .group = ContentGroup::Poses,
    .needs = kNeedsRgb | kNeedsDepth,
    .files = kTartanAirFiles,
    .folders = kTartanAirFolders,
    .write = writeTartanAir,
    .encode = encodeTartanAir,
    .convention = tartanAirConvention,
    .bytes_per_pixel = 17.0,
};

}  // namespace dollytrack::render
