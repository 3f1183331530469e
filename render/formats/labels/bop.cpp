#include "render/formats/labels/bop.h"

#include "engine/camera/intrinsics.h"
#include "engine/io/files/png_writer.h"
#include "render/dataset/contents/frame_context.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kBopFiles = {"scene_camera.json", "scene_gt.json",
                                                  "scene_gt_info.json"};
constexpr std::array<const char*, 2> kBopFolders = {"mask", "mask_visib"};

template <class Matrix>
Json rows(const Matrix& matrix) {
    Json values = Json::array();
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
        for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
            values.push_back(matrix(row, column) + 0.0);
        }
    }
    return values;
}

constexpr double kMillimetres = 1000.0;

Json camera(const DatasetContents& contents, const Pose& pose) {
    const Intrinsics lens = makeIntrinsics(contents.camera);
    Eigen::Matrix3d k;
    // BOP puts pixel centres at integer coordinates.
    k << lens.fx, 0, lens.cx - 0.5, 0, lens.fy, lens.cy - 0.5, 0, 0, 1;
    return {{"cam_K", rows(k)},
            {"depth_scale", 1.0},
            {"cam_R_w2c", rows(pose.rotation.conjugate().toRotationMatrix())},
            {"cam_t_w2c",
             rows(Eigen::Vector3d(kMillimetres * pose.toCamera(Eigen::Vector3d::Zero())))}};
}

Result<std::vector<DatasetFile>> writeBop(const DatasetContents& contents) {
    Json cameras = Json::object(), truths = Json::object(), infos = Json::object();
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const DatasetFrame& frame = contents.frames[i];
        const std::string key = std::to_string(i);
        cameras[key] = camera(contents, frame.camera.pose);
        Json truth = Json::array(), info = Json::array();
        for (const InstanceInFrame& seen : frame.instances) {
            const BoxInCamera box =
                boxInCamera(contents.scene.object(seen.object_id),
                            motionOf(contents.motions, seen.object_id, i), frame.camera.pose);
            truth.push_back({{"obj_id", seen.object_id},
                             {"cam_R_m2c", rows(box.rotation.toRotationMatrix())},
                             {"cam_t_m2c", rows(Eigen::Vector3d(kMillimetres * box.center))}});
            info.push_back({{"bbox_obj", seen.amodal_box},
                            {"bbox_visib", seen.box},
                            {"px_count_all", seen.whole_px},
                            {"px_count_valid", seen.silhouette_px},
                            {"px_count_visib", seen.visible_px},
                            {"visib_fract", seen.visibleFraction()}});
        }
        truths[key] = std::move(truth);
        infos[key] = std::move(info);
    }
    return std::vector<DatasetFile>{{kBopFiles[0], cameras.dump(1) + "\n"},
                                    {kBopFiles[1], truths.dump(1) + "\n"},
                                    {kBopFiles[2], infos.dump(1) + "\n"}};
}

/// Masks of each object, numbered as in scene_gt.json.
Result<std::vector<FrameFile>> encodeBop(const FrameContext& /*context*/,
                                         const FrameRecord& frame) {
    std::vector<FrameFile> files;
    int number = 0;
    for (const InstanceInFrame& seen : measureInstances(frame)) {
        const auto whole = std::find_if(
            frame.whole.begin(), frame.whole.end(),
            [&](const RenderedAmodalMask& mask) { return mask.object_id == seen.object_id; });
        std::vector<std::uint8_t> visible(frame.instance.size()), all(frame.instance.size());
        for (std::size_t i = 0; i < visible.size(); ++i) {
            const int x = static_cast<int>(i) % frame.width;
            const int y = static_cast<int>(i) / frame.width;
            if (frame.instance[i] == seen.object_id) visible[i] = all[i] = 255;
            if (whole != frame.whole.end() && whole->covers(x, y)) all[i] = 255;
        }
        for (const auto& [folder, pixels] :
             {std::pair{kBopFolders[0], &all}, std::pair{kBopFolders[1], &visible}}) {
            auto png = encodePng(frame.width, frame.height, PngFormat::Gray8, *pixels);
            if (!png) return tl::unexpected(std::move(png.error()));
            files.push_back({pairFile(folder, frame.index, number, ".png"), std::move(*png)});
        }
        ++number;
    }
    return files;
}

Json bopConvention(const DatasetContents& /*contents*/) {
    return {{"files", kBopFiles},
            {"folders", kBopFolders},
            {"format",
             "BOP: this folder is one scene (rgb, depth, mask, mask_visib); millimetres; row-major "
             "camera_from_world and camera_from_model; a model's origin and axes are the centre "
             "and the axes of the object's box; depth_scale 1; bbox_obj is of the silhouette "
             "inside the image; px_count_all also counts pixels outside the image"}};
}

}  // namespace

const Format kBopFormat = {
    .name = "bop",
    .text = "poses, visibility and masks of objects in BOP's format, in scene_gt.json, mask ...",
    .group = ContentGroup::Labels,
    .needs = kNeedsWhole,
    .files = kBopFiles,
    .folders = kBopFolders,
    .write = writeBop,
    .encode = encodeBop,
    .convention = bopConvention,
    .bytes_per_pixel = 0.3,
    .outlines_things = true,
};

}  // namespace dollytrack::render
