#pragma once

#include "engine/io/pointcloud/cloud_planes.h"
#include "engine/io/pointcloud/cloud_samples.h"
#include "engine/math/up_axis.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::io {

/// Which way is up in a cloud, in the file's axes.
struct CloudUp {
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // unit
    std::string source;                             // how it was found, for people
    bool doubtful = false;
};

/// Judged from floors and ceilings (large planes that face up below and down above), from which
/// way the scanner looked (a camera's y axis points down), and from habit; then levelled, within 30
/// degrees, by the floor or across the walls. With `axis` no other one comes into question.
CloudUp findUp(const CloudSamples& samples, const std::vector<CloudPlane>& planes,
               std::optional<UpAxis> axis);

}  // namespace dollytrack::io
