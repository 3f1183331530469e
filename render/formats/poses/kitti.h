#pragma once

#include "render/dataset/contents/format.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// KITTI odometry: poses.txt, times.txt and calib.txt; and flow to the next frame in kitti_flow.
extern const Format kKittiFormat;

/// Flow as in KITTI's PNG files: three values per pixel, all 0 if unknown or if a component exceeds
/// about 512 px.
[[nodiscard]] std::vector<std::uint16_t> kittiFlow(const std::vector<Eigen::Vector2f>& motion);

}  // namespace dollytrack::render
