#pragma once

#include "render/verify/read/stored_dataset.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// A ray in a camera's axes; lengths along it are depths as the camera's images have them.
struct StoredRay {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// A camera of the rig as dataset.json describes it, with a lens of its own: none of the code that
/// made the images.
struct StoredCamera {
    std::string name;
    std::string lens;
    int width = 0;
    int height = 0;
    double focal = 0.0;  // px; px a metre of parallel rays
    double cx = 0.0;
    double cy = 0.0;
    std::array<double, 4> k = {};
    double widest = 0.0;  // of a fisheye, radians
    bool range = false;   // depth is along the ray
    bool level = false;
    Pose carrier_from_camera;
    std::vector<Pose> poses;
    std::vector<double> quaternion_lengths;

    [[nodiscard]] std::string file(const char* image, int frame) const;
    /// Through an image position; nothing outside of a fisheye's circle.
    [[nodiscard]] std::optional<StoredRay> rayThrough(double x, double y) const;
    /// Where it has to be when the planned camera is there.
    [[nodiscard]] Pose expectedPose(const Pose& planned) const;
};

/// The images of each.
inline constexpr std::array kStoredRigImages = {"rgb", "depth", "instance", "semantic",
                                                "normal_world"};

/// Error: BadInput, a sentence of what is missing or wrong in dataset.json.
Result<std::vector<StoredCamera>> readStoredRig(const StoredDataset& dataset);

/// All image files that the rig must have; none where dataset.json cannot tell.
std::vector<std::string> rigImageFiles(const StoredDataset& dataset);

}  // namespace dollytrack::verify
