#include "render/formats/nerfstudio.h"

#include "render/formats/transforms.h"

#include <nlohmann/json.hpp>

#include <array>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 1> kFiles = {"transforms.json"};

Result<std::vector<DatasetFile>> write(const DatasetContents& contents) {
    Json root = {{"camera_model", "OPENCV"}};
    root.update(transformsLens(contents));
    Json frames = Json::array();
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const int index = static_cast<int>(i);
        Json frame = {{"file_path", contents.pictureFile(index)},
                      {"transform_matrix", transformRows(contents.frames[i].camera.pose)}};
        if (contains(contents.modalities, "depth")) {
            frame["depth_file_path"] = frameFile("depth", index);
        }
        frames.push_back(std::move(frame));
    }
    root["frames"] = std::move(frames);
    return std::vector<DatasetFile>{{kFiles[0], root.dump(1) + "\n"}};
}

Json convention(const DatasetContents& /*contents*/) {
    return {{"files", kFiles},
            {"format",
             "nerfstudio: world from camera, the camera's axes x right, y up, z back, world z up, "
             "metres; depth in millimetres (depth_unit_scale_factor 0.001)"}};
}

}  // namespace

const Format kNerfstudioFormat = {
    .name = "nerfstudio",
    .text = "poses for nerfstudio, in transforms.json",
    .standard = false,
    .needs = 0,
    .files = kFiles,
    .folders = {},
    .write = write,
    .encode = nullptr,
    .convention = convention,
};

}  // namespace dollytrack::render
