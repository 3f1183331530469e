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

Json transformsLens(const DatasetContents& contents) {
    const Intrinsics lens = makeIntrinsics(contents.camera);
    return {{"fl_x", lens.fx}, {"fl_y", lens.fy},  {"cx", lens.cx}, {"cy", lens.cy},
            {"w", lens.width}, {"h", lens.height}, {"k1", 0.0},     {"k2", 0.0},
            {"p1", 0.0},       {"p2", 0.0}};
}

}  // namespace dollytrack::render
