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
    int line = 0;    // of the text, 1..; 0 where lines do not count
};

struct PoseList {
    std::vector<ReadPose> poses;
    std::optional<double> hfov_deg;  // of the lens, where the file tells it
};

/// A file as its reader gets it, read once: a pipe tells its text only once.
struct PoseFile {
    std::filesystem::path path;
    std::string text;  // empty for Hypersim, which is a folder of two files that are no text
};

/// Readers of one format each. Their errors are BadInput, one sentence with file and line. That
/// positions and times make sense is looked after by loadTrajectory(), for all alike.
Result<PoseList> readTum(const PoseFile& file);
Result<PoseList> readKitti(const PoseFile& file);
Result<PoseList> readTartanAir(const PoseFile& file);
Result<PoseList> readSceneNet(const PoseFile& file);
Result<PoseList> readColmap(const PoseFile& file);
Result<PoseList> readTransforms(const PoseFile& file);
Result<PoseList> readFront3d(const PoseFile& file);
Result<PoseList> readHypersim(const PoseFile& file);
Result<PoseList> readSweetHome(const PoseFile& file);

}  // namespace dollytrack::io
