#include "render/formats/poses/instant_ngp.h"

#include "render/formats/poses/calibration.h"
#include "render/formats/poses/transforms.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 1> kInstantNgpFiles = {"transforms_ngp.json"};
constexpr double kFilled = 0.95;  // share of the unit cube's edge, because surfaces on its faces
                                  // flicker

/// Box around the rooms and all cameras.
Eigen::AlignedBox3d spanOf(const DatasetContents& contents) {
    Eigen::AlignedBox3d span = contents.scene.room_bounds;
    for (const DatasetFrame& frame : contents.frames) span.extend(frame.camera.pose.position);
    return span;
}

Result<std::vector<DatasetFile>> writeInstantNgp(const DatasetContents& contents) {
    const Eigen::AlignedBox3d span = spanOf(contents);
    const double scale = kFilled / std::max(span.sizes().maxCoeff(), 1e-3);
    // Applied after scaling, before instant-ngp permutes axes: the centre becomes (0.5, 0.5, 0.5).
    const Eigen::Vector3d offset = Eigen::Vector3d::Constant(0.5) - scale * span.center();
    const Json lens = transformsLens(contents);
    const auto angle = [&](const char* size, const char* focal) {
        return 2.0 * std::atan(0.5 * lens[size].get<double>() / lens[focal].get<double>());
    };
    Json root = {{"camera_angle_x", angle("w", "fl_x")}, {"camera_angle_y", angle("h", "fl_y")}};
    root.update(lens);
    root.update(Json{
        {"aabb_scale", 1}, {"scale", scale}, {"offset", {offset.x(), offset.y(), offset.z()}}});
    if (contains(contents.modalities, "depth") && pictureDistortion(contents).none()) {
        root["enable_depth_loading"] = true;
        root["integer_depth_scale"] = 0.001;  // metres per step; `scale` is applied in addition
    }
    root["frames"] = transformFrames(contents, "depth_path");
    return std::vector<DatasetFile>{{kInstantNgpFiles[0], root.dump(1) + "\n"}};
}

Json instantNgpConvention(const DatasetContents& /*contents*/) {
    return {{"files", kInstantNgpFiles},
            {"format",
             "instant-ngp: world_from_camera, camera axes x right, y up, z back, world z up, "
             "metres; `scale` and `offset` map the whole room into the unit cube"}};
}

}  // namespace

const Format kInstantNgpFormat = {
    .name = "instant_ngp",
    .text = "poses for instant-ngp, in transforms_ngp.json",
    .group = ContentGroup::Poses,
    .files = kInstantNgpFiles,
    .write = writeInstantNgp,
    .convention = instantNgpConvention,
};

}  // namespace dollytrack::render
