#pragma once

#include "render/verify/read/frame_images.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace dollytrack::verify {

/// Path of an image in the dataset; sensor images may be JPEG.
std::string storedFile(const StoredDataset& dataset, const ImageKind& kind, int frame);

/// conventions.rgb_sensor.distortion: OpenCV's model, implemented independently.
struct StoredDistortion {
    double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;

    [[nodiscard]] bool none() const {
        return k1 == 0.0 && k2 == 0.0 && p1 == 0.0 && p2 == 0.0 && k3 == 0.0;
    }
    /// Position in the sensor image (px) of what an undistorted image shows at (x, y).
    [[nodiscard]] Eigen::Vector2d inSensor(const Intrinsics& lens, double x, double y) const;
};
/// Nothing if the dataset does not specify it.
std::optional<StoredDistortion> distortionOf(const StoredDataset& dataset);

/// Distortion of the images that pose formats refer to: the sensor's if there are no clean
/// images, else none.
StoredDistortion distortionOfPictures(const StoredDataset& dataset);

}  // namespace dollytrack::verify
