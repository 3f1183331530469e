#pragma once

#include "render/dataset/contents/format.h"

#include <string>

namespace dollytrack::render {

/// The text of imu.csv in EuRoC's columns: nanoseconds, angular rate (rad/s) and specific force
/// (m/s2, including gravity) in camera axes, at contents.imu_rate_hz along each continuous path of
/// the dataset. Jumps between paths have no rows.
[[nodiscard]] std::string imuCsvText(const DatasetContents& contents);

/// imu.csv of a dataset.
extern const Format kImuFormat;

}  // namespace dollytrack::render
