#pragma once

#include "engine/io/pointcloud/cloud_planes.h"
#include "engine/io/pointcloud/cloud_samples.h"
#include "engine/io/settings/cloud_params.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

/// An object or structure in a cloud.
struct CloudObject {
    std::string name;
    int nyu40 = 0;
    bool structure = false;
};

/// The object of every sample.
struct CloudLabels {
    std::vector<CloudObject> objects;
    std::vector<int> object_of;  // index into `objects` by sample; -1: too small a piece
    std::size_t specks = 0;      // number of samples with -1
};

/// Segments a cloud. Floor, ceiling and walls are planes at its border, with hardly any points
/// behind them. Each connected piece of the rest is one object; pieces that stand on its largest
/// flat top are objects of their own. Objects are named furniture_1 and so on. `up` is a unit
/// vector.
CloudLabels labelCloud(const CloudSamples& samples, const std::vector<CloudPlane>& planes,
                       const Eigen::Vector3d& up, const CloudParams& params);

}  // namespace dollytrack
