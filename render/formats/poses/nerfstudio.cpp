#include "render/formats/poses/nerfstudio.h"

#include "render/formats/poses/transforms.h"

#include <nlohmann/json.hpp>

#include <array>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 1> kNerfstudioFiles = {"transforms.json"};

Result<std::vector<DatasetFile>> writeNerfstudio(const DatasetContents& contents) {
    Json root = {{"camera_model", "OPENCV"}};
    root.update(transformsLens(contents));
    root["frames"] = transformFrames(contents, "depth_file_path");
    return std::vector<DatasetFile>{{kNerfstudioFiles[0], root.dump(1) + "\n"}};
}

Json nerfstudioConvention(const DatasetContents& /*contents*/) {
    return {{"files", kNerfstudioFiles},
            {"format",
             "nerfstudio: world_from_camera, camera axes x right, y up, z back, world z up, "
             "metres; depth in millimetres (depth_unit_scale_factor 0.001)"}};
}

}  // namespace

const Format kNerfstudioFormat = {
    .name = "nerfstudio",
    .text = "poses for nerfstudio, in transforms.json",
    .group = ContentGroup::Poses,
    .files = kNerfstudioFiles,
    .write = writeNerfstudio,
    .convention = nerfstudioConvention,
};

}  // namespace dollytrack::render
