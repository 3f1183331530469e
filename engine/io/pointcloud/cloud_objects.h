#pragma once

#include "engine/io/pointcloud/cloud_params.h"
#include "engine/io/pointcloud/cloud_planes.h"
#include "engine/io/pointcloud/cloud_samples.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::io {

/// Something that points of a cloud belong to.
struct CloudThing {
    std::string name;
    int nyu40 = 0;
    bool structure = false;
};

/// What every sample belongs to.
struct CloudLabels {
    std::vector<CloudThing> things;
    std::vector<int> thing_of;  // by sample; -1: a speck, to be dropped
    std::size_t specks = 0;     // samples dropped
};

/// Floor, ceiling and walls are planes at the edge of the cloud (nothing lies behind them); what
/// remains is one thing for each connected piece, and what stands on a flat top of a thing is a
/// thing of its own. `up` is a unit vector.
CloudLabels labelCloud(const CloudSamples& samples, const std::vector<CloudPlane>& planes,
                       const Eigen::Vector3d& up, const CloudParams& params);

}  // namespace dollytrack::io
