#include "render/formats/transforms.h"

#include "engine/camera/intrinsics.h"

#include <nlohmann/json.hpp>

namespace dollytrack::render {

using Json = nlohmann::ordered_json;

Json transformRows(const Pose& pose) {
    Eigen::Matrix4d matrix = pose.worldFromCamera().matrix();
    matrix.middleCols<2>(1) *= -1.0;
    Json rows = Json::array();
    for (int row = 0; row < 4; ++row) {
        Json values = Json::array();
        for (int column = 0; column < 4; ++column) values.push_back(matrix(row, column) + 0.0);
        rows.push_back(std::move(values));
    }
    return rows;
}

Json transformFrames(const DatasetContents& contents, const char* depth_key) {
    const bool depth = contains(contents.modalities, "depth");
    Json frames = Json::array();
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const int index = static_cast<int>(i);
        Json frame = {{"file_path", contents.pictureFile(index)},
                      {"transform_matrix", transformRows(contents.frames[i].camera.pose)}};
        if (depth) frame[depth_key] = frameFile("depth", index);
        frames.push_back(std::move(frame));
    }
    return frames;
}

Json transformsLens(const DatasetContents& contents) {
    const Intrinsics lens = makeIntrinsics(contents.camera);
    return {{"fl_x", lens.fx}, {"fl_y", lens.fy},  {"cx", lens.cx}, {"cy", lens.cy},
            {"w", lens.width}, {"h", lens.height}, {"k1", 0.0},     {"k2", 0.0},
            {"p1", 0.0},       {"p2", 0.0}};
}

}  // namespace dollytrack::render
