#include "render/formats/poses/tum.h"

#include "engine/io/files/png_writer.h"
#include "engine/io/trajectories/trajectory_file.h"
#include "render/dataset/contents/frame_context.h"
#include "render/encoders/pack.h"
#include "render/formats/poses/frame_text.h"

#include <nlohmann/json.hpp>

#include <array>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 4> kTumFiles = {"groundtruth.txt", "rgb.txt", "depth.txt",
                                                  "associations.txt"};

constexpr std::array<const char*, 1> kTumFolders = {"depth_tum"};
constexpr float kDepthPerMetre = 5000.0F;

/// List of one folder's images.
std::string tumImageList(const DatasetContents& contents, const char* folder) {
    std::string text = "# timestamp filename\n";
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        text += stampText(contents.frames[i].camera.time_s) + " " +
                frameFile(folder, static_cast<int>(i)) + "\n";
    }
    return text;
}

/// Colour before depth, as ORB-SLAM reads it.
std::string associations(const DatasetContents& contents) {
    std::string text;
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const std::string stamp = stampText(contents.frames[i].camera.time_s);
        text += stamp + " " + frameFile("rgb", static_cast<int>(i)) + " " + stamp + " " +
                frameFile(kTumFolders[0], static_cast<int>(i)) + "\n";
    }
    return text;
}

Result<std::vector<DatasetFile>> writeTum(const DatasetContents& contents) {
    std::string poses = "# timestamp tx ty tz qx qy qz qw\n";
    for (const DatasetFrame& frame : contents.frames) {
        poses += tumLine(frame.camera.time_s, frame.camera.pose) + "\n";
    }
    std::vector<DatasetFile> files = {{kTumFiles[0], std::move(poses)}};
    // Lists only images that exist.
    const bool rgb = contains(contents.modalities, "rgb");
    if (rgb) files.push_back({kTumFiles[1], tumImageList(contents, "rgb")});
    files.push_back({kTumFiles[2], tumImageList(contents, kTumFolders[0])});
    if (rgb) files.push_back({kTumFiles[3], associations(contents)});
    return files;
}

/// Depth beyond 13.1 m does not fit into 16 bits and becomes 0, unmeasured.
Result<std::vector<FrameFile>> encodeTum(const FrameContext& /*context*/,
                                         const FrameRecord& frame) {
    std::vector<std::uint16_t> depth(frame.depth_m.size());
    for (std::size_t i = 0; i < depth.size(); ++i) {
        const float value = frame.depth_m[i] * kDepthPerMetre + 0.5F;
        depth[i] = value < 65536.0F ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
    }
    return oneFile(frameFile(kTumFolders[0], frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Gray16, bytesOf(depth)));
}

nlohmann::ordered_json tumConvention(const DatasetContents& /*contents*/) {
    return {{"files", kTumFiles},
            {"folder", kTumFolders[0]},
            {"format",
             "TUM RGB-D: seconds, position and quaternion (x y z w) of the camera's centre in the "
             "world, camera axes x right, y down, z forward; depth_tum: planar, 5000 units per "
             "metre, 0 where no surface is visible and beyond 13.1 m"},
            {"depth_per_m", kDepthPerMetre}};
}

}  // namespace

const Format kTumFormat = {
    .name = "tum",
    .text = "poses and lists of images in TUM RGB-D's format, in groundtruth.txt, rgb.txt ...",
    .group = ContentGroup::Poses,
    .needs = kNeedsDepth,
    .files = kTumFiles,
    .folders = kTumFolders,
    .write = writeTum,
    .encode = encodeTum,
    .convention = tumConvention,
    .bytes_per_pixel = 0.4,
};

}  // namespace dollytrack::render
