#pragma once

#include "engine/io/pointcloud/cloud_objects.h"
#include "engine/io/pointcloud/cloud_samples.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Core>

#include <optional>

namespace dollytrack {

/// Adds a horizontal grey floor below a scan: just below the scanned floor, else below all points.
/// It extends over the scan and the scanner's position (`viewpoint`; if unknown, about a metre and
/// a half in front of surfaces that all face one way). Scans show no floor behind furniture and
/// where the scanner stood, and without a floor no place would count as inside. Metres.
void addFloor(const CloudSamples& samples, const CloudLabels& labels,
              const std::optional<Eigen::Vector3d>& viewpoint, UpAxis up, RawScene& raw);

}  // namespace dollytrack
