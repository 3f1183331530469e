#include "engine/io/files/bounded_json.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/trajectories/pose_list.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace dollytrack {
namespace {

std::optional<double> hfovOf(const nlohmann::json& root) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    if (root.contains("fl_x") && root.contains("w")) {
        return 2.0 * std::atan(0.5 * root["w"].get<double>() / root["fl_x"].get<double>()) *
               kDegrees;
    }
    if (root.contains("camera_angle_x")) return root["camera_angle_x"].get<double>() * kDegrees;
    return std::nullopt;
}

}  // namespace

// transforms.json of nerfstudio and instant-ngp: world_from_camera, camera axes x right, y up, z
// back, world z up.
Result<PoseList> readTransforms(const PoseFile& file) {
    PoseList list;
    std::size_t frame = 0;
    const auto where = [&] { return fmt::format("{}: frames[{}]", file.path.string(), frame); };
    const Result<nlohmann::json> root = parseBoundedJson(file.text, file.path.string());
    if (!root) return tl::unexpected(root.error());
    try {
        for (const nlohmann::json& one : root->at("frames")) {
            const nlohmann::json& rows = one.at("transform_matrix");
            Eigen::Matrix<double, 3, 4> matrix;
            for (int row = 0; row < 3; ++row) {
                for (int column = 0; column < 4; ++column) {
                    matrix(row, column) = rows.at(row).at(column).get<double>();
                }
            }
            const Eigen::Matrix3d written = matrix.leftCols<3>();
            auto rotation = rotationFrom(written, where());
            if (!rotation) return tl::unexpected(std::move(rotation.error()));
            const double rotation_error = (written - *rotation).norm();
            rotation->rightCols<2>() *= -1.0;
            list.poses.push_back({matrix.col(3), *rotation, std::nullopt, 0, 0, rotation_error});
            ++frame;
        }
        list.hfov_deg = hfovOf(*root);
    } catch (const nlohmann::json::exception& error) {
        return fail(ErrorCode::BadInput,
                    fmt::format("The file is not a transforms.json ({}).", plainReason(error)),
                    where());
    }
    if (list.poses.empty()) {
        return fail(ErrorCode::BadInput, "The file has no frames.", file.path.string());
    }
    return list;
}

}  // namespace dollytrack
