#pragma once

#include "render/verify/read/frame_images.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace dollytrack::verify {

/// An image's file as it lies in the dataset: pictures of the sensor may be JPEG.
std::string storedFile(const StoredDataset& dataset, const ImageKind& kind, int frame);

/// conventions.rgb_sensor.distortion, as an own reading of OpenCV's model.
struct StoredDistortion {
    double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;

    [[nodiscard]] bool none() const {
        return k1 == 0.0 && k2 == 0.0 && p1 == 0.0 && p2 == 0.0 && k3 == 0.0;
    }
    /// Where the sensor's picture (px) shows what a sharp one shows at (x, y).
    [[nodiscard]] Eigen::Vector2d inSensor(const Intrinsics& lens, double x, double y) const;
};
/// Nothing where the dataset does not say it.
std::optional<StoredDistortion> distortionOf(const StoredDataset& dataset);

/// The distortion of the pictures that formats of poses name: the sensor's where there are no
/// clean ones, else none.
StoredDistortion distortionOfPictures(const StoredDataset& dataset);

}  // namespace dollytrack::verify
