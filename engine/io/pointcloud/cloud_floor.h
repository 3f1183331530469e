#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/pointcloud/cloud_objects.h"
#include "engine/io/pointcloud/cloud_samples.h"

#include <Eigen/Core>

#include <optional>

namespace dollytrack::io {

/// Puts a level, grey floor under a scan: just below the floor that was scanned, else below all of
/// it; as far as the scan and whoever made it (the viewpoint, else a metre and a half before
/// surfaces that all face one way). Scans show no floor behind furniture and none where the scanner
/// stood, and without a floor nothing is inside. Metres.
void addFloor(const CloudSamples& samples, const CloudLabels& labels,
              const std::optional<Eigen::Vector3d>& viewpoint, UpAxis up, RawScene& raw);

}  // namespace dollytrack::io
