#pragma once

#include "render/dataset/dataset_contents.h"

#include <string>

namespace dollytrack::render {

/// The text of imu.csv, in EuRoC's columns: nanoseconds, angular rate (rad/s) and specific force
/// (m/s2, gravity included) in the camera's axes, at contents.imu_rate_hz along each continuous
/// motion of the dataset. Between motions, where the camera is carried over, there is nothing.
[[nodiscard]] std::string imuCsvText(const DatasetContents& contents);

}  // namespace dollytrack::render
