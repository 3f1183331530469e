#pragma once

#include "render/verify/read/stored_dataset.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// A ray in camera axes, scaled so that lengths along it are depths of the camera's images.
struct StoredRay {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// A rig camera as described in dataset.json, with its own lens model, independent of the code that
/// made the images.
struct StoredCamera {
    std::string name;
    std::string lens;
    int width = 0;
    int height = 0;
    double focal = 0.0;  // px; px per metre for an orthographic lens
    double cx = 0.0;
    double cy = 0.0;
    std::array<double, 4> k = {};
    double widest = 0.0;  // half field of view of a fisheye, radians
    bool range = false;   // depth is measured along the ray
    bool level = false;
    Pose carrier_from_camera;
    double mount_length = 1.0;  // of its quaternion, as stored
    std::vector<Pose> poses;
    std::vector<double> quaternion_lengths;

    [[nodiscard]] std::string file(const char* image, int frame) const;
    /// The ray through an image position; nothing outside a fisheye's image circle.
    [[nodiscard]] std::optional<StoredRay> rayThrough(double x, double y) const;
    /// World pose of this camera for a pose of the planned camera.
    [[nodiscard]] Pose expectedPose(const Pose& planned) const;
};

/// Image kinds of each camera.
inline constexpr std::array kStoredRigImages = {"rgb", "depth", "instance", "semantic",
                                                "normal_world"};

/// Reads the rig's cameras from dataset.json. Returns BadInput, describing what is missing or
/// wrong.
Result<std::vector<StoredCamera>> readStoredRig(const StoredDataset& dataset);

/// All image files that the rig must have; none if dataset.json is invalid.
std::vector<std::string> rigImageFiles(const StoredDataset& dataset);

}  // namespace dollytrack::verify
