#pragma once

#include "engine/core/result.h"
#include "engine/math/pose.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::io {

/// One pose as a file has it, in the file's own world, but with our camera axes: x right, y down,
/// z forward.
struct ReadPose {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // file's world from camera
    std::optional<double> time_s;
    int motion = 0;  // changes where the camera was carried over
};

struct PoseList {
    std::vector<ReadPose> poses;
    std::optional<double> hfov_deg;  // of the lens, where the file tells it
};

/// Readers of one format each. Their errors are BadInput, one sentence with file and line.
Result<PoseList> readTum(const std::filesystem::path& path);
Result<PoseList> readKitti(const std::filesystem::path& path);
Result<PoseList> readTartanAir(const std::filesystem::path& path);
Result<PoseList> readSceneNet(const std::filesystem::path& path);
Result<PoseList> readColmap(const std::filesystem::path& path);
Result<PoseList> readTransforms(const std::filesystem::path& path);
Result<PoseList> readFront3d(const std::filesystem::path& path);
Result<PoseList> readHypersim(const std::filesystem::path& path);

}  // namespace dollytrack::io
