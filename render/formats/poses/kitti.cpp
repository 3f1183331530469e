#include "render/formats/poses/kitti.h"

#include "engine/camera/intrinsics.h"
#include "engine/io/files/png_writer.h"
#include "render/dataset/contents/frame_context.h"
#include "render/encoders/pack.h"
#include "render/formats/poses/frame_text.h"
#include "render/truth/motion_field.h"

#include <nlohmann/json.hpp>

#include <array>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 3> kKittiFiles = {"poses.txt", "times.txt", "calib.txt"};

constexpr std::array<const char*, 1> kKittiFolders = {"kitti_flow"};

/// KITTI puts the first pixel's centre at (0, 0), so the principal point is half a pixel less.
std::string projection(const Intrinsics& lens, double right_m) {
    Eigen::Matrix<double, 3, 4> matrix;
    matrix << lens.fx, 0, lens.cx - 0.5, -lens.fx * right_m, 0, lens.fy, lens.cy - 0.5, 0, 0, 0, 1,
        0;
    return rowsText(matrix);
}

Result<std::vector<DatasetFile>> writeKitti(const DatasetContents& contents) {
    std::string poses, times;
    const Eigen::Isometry3d first_from_world =
        contents.frames.front().camera.pose.worldFromCamera().inverse();
    for (const DatasetFrame& frame : contents.frames) {
        const Eigen::Isometry3d first_from_camera =
            first_from_world * frame.camera.pose.worldFromCamera();
        poses += rowsText(first_from_camera.matrix().topRows<3>()) + "\n";
        times += stampText(frame.camera.time_s) + "\n";
    }
    const Intrinsics lens = makeIntrinsics(contents.camera);
    std::string calibration;
    for (int camera = 0; camera < 4; ++camera) {
        // 0 and 2 are left cameras, 1 and 3 right cameras.
        const double right_m = camera % 2 == 1 ? contents.stereo_baseline_m : 0.0;
        calibration += fmt::format("P{}: {}\n", camera, projection(lens, right_m));
    }
    return std::vector<DatasetFile>{{kKittiFiles[0], std::move(poses)},
                                    {kKittiFiles[1], std::move(times)},
                                    {kKittiFiles[2], std::move(calibration)}};
}

/// Flow to the next frame, if there is one.
Result<std::vector<FrameFile>> encodeKitti(const FrameContext& context, const FrameRecord& frame) {
    const int next = frame.index + 1;
    if (next >= static_cast<int>(context.contents.frames.size())) return std::vector<FrameFile>{};
    const MotionField field = motionField(context, frame, next);
    return oneFile(
        frameFile(kKittiFolders[0], frame.index),
        encodePng(frame.width, frame.height, PngFormat::Rgb16, bytesOf(kittiFlow(field.motion))));
}

nlohmann::ordered_json kittiConvention(const DatasetContents& /*contents*/) {
    return {{"files", kKittiFiles},
            {"folder", kKittiFolders[0]},
            {"format",
             "KITTI odometry: one row-major 3 x 4 matrix per line, from camera i to the first "
             "camera (its pose in the world: frames[0]); times in seconds; projections P0 to P3 "
             "with pixel centres at integer coordinates, 1 and 3 of the right camera; kitti_flow: "
             "uint16 x 3, flow to the next frame, u = (R - 32768) / 64, v likewise from G, B is 1 "
             "where both are valid"}};
}

}  // namespace

std::vector<std::uint16_t> kittiFlow(const std::vector<Eigen::Vector2f>& motion) {
    std::vector<std::uint16_t> pixels;
    pixels.reserve(3 * motion.size());
    for (const Eigen::Vector2f& flow : motion) {
        const Eigen::Vector2f steps = (64.0F * flow).array().round() + 32768.0F;
        const bool fits = steps.minCoeff() >= 0.0F && steps.maxCoeff() <= 65535.0F;
        for (int c = 0; c < 2; ++c) {
            pixels.push_back(fits ? static_cast<std::uint16_t>(steps[c]) : std::uint16_t{0});
        }
        pixels.push_back(fits ? 1 : 0);
    }
    return pixels;
}

const Format kKittiFormat = {
    .name = "kitti",
    .text = "poses, times and projections in KITTI odometry's format, in poses.txt ...",
    .group = ContentGroup::Poses,
    .needs = kNeedsDepth,
    .files = kKittiFiles,
    .folders = kKittiFolders,
    .write = writeKitti,
    .encode = encodeKitti,
    .convention = kittiConvention,
    .bytes_per_pixel = 3.0,
};

}  // namespace dollytrack::render
