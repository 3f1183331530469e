#pragma once

#include "render/formats/formats.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// KITTI odometry: poses.txt, times.txt and calib.txt; and flow to the next frame, in kitti_flow.
extern const Format kKittiFormat;

/// Flow as KITTI's pictures hold it: three values a pixel, all 0 where there is none or where it is
/// longer than some 512 px and does not fit.
[[nodiscard]] std::vector<std::uint16_t> kittiFlow(const std::vector<Eigen::Vector2f>& motion);

}  // namespace dollytrack::render
