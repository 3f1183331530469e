#pragma once

#include "engine/core/result.h"
#include "engine/math/pose.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// A pose of a file, in the file's world, with the camera's axes converted to x right, y down, z
/// forward.
struct FilePose {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // file's world from camera
    std::optional<double> time_s;
    int motion = 0;  // number of the continuous motion; changes where the camera jumps
    int line = 0;    // in the file, from 1; 0 if the format has no lines
    /// Distance (Frobenius norm) of the file's matrix from `rotation`, the nearest one; 0 for
    /// formats with quaternions or targets.
    double rotation_error = 0.0;
};

struct PoseList {
    std::vector<FilePose> poses;
    std::optional<double> hfov_deg;  // horizontal field of view, if the file contains it
};

/// Path and text of a file. The text is read only once, because it may be a pipe.
struct PoseFile {
    std::filesystem::path path;
    std::string text;  // empty for Hypersim, which is a folder of two binary files
};

/// Readers of one format each. Error: BadInput, with file and line. loadTrajectory() checks
/// positions and times for all formats.
Result<PoseList> readTum(const PoseFile& file);
Result<PoseList> readKitti(const PoseFile& file);
Result<PoseList> readTartanAir(const PoseFile& file);
Result<PoseList> readSceneNet(const PoseFile& file);
Result<PoseList> readColmap(const PoseFile& file);
Result<PoseList> readTransforms(const PoseFile& file);
Result<PoseList> readFront3d(const PoseFile& file);
Result<PoseList> readHypersim(const PoseFile& file);
Result<PoseList> readSweetHome(const PoseFile& file);

}  // namespace dollytrack
