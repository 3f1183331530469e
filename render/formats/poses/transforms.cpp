#include "render/formats/poses/transforms.h"

#include "engine/camera/intrinsics.h"
#include "render/formats/poses/calibration.h"

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
    // Depth is undistorted, and readers would undistort it together with the images.
    const bool depth = contains(contents.modalities, "depth") && pictureDistortion(contents).none();
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
    const LensDistortion bent = pictureDistortion(contents);
    Json result = {{"fl_x", lens.fx}, {"fl_y", lens.fy},  {"cx", lens.cx}, {"cy", lens.cy},
                   {"w", lens.width}, {"h", lens.height}, {"k1", bent.k1}, {"k2", bent.k2},
                   {"p1", bent.p1},   {"p2", bent.p2}};
    if (bent.k3 != 0.0) result["k3"] = bent.k3;
    return result;
}

}  // namespace dollytrack::render
