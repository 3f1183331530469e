#pragma once

#include "engine/io/pointcloud/cloud_planes.h"
#include "engine/io/pointcloud/cloud_samples.h"
#include "engine/math/up_axis.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// The up direction of a cloud, in the file's axes.
struct CloudUp {
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // unit
    std::string source;                             // how it was found, as text for the user
    bool doubtful = false;
};

/// Estimates the up axis from floors and ceilings (large planes that face up at the bottom and down
/// at the top), the tops of furniture, the scanner's direction (a camera's y axis points down) and
/// common conventions.
/// Then tilts it by at most 30 degrees to the normal of the largest floor or ceiling, or to be
/// parallel to the walls. If `axis` is given, only that one is considered.
/// @param file_origin  position of the file's origin in the coordinates of the samples, m
CloudUp findUp(const CloudSamples& samples, const std::vector<CloudPlane>& planes,
               const Eigen::Vector3d& file_origin, std::optional<UpAxis> axis);

}  // namespace dollytrack
