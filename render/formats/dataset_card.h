#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/trajectory.h"
#include "engine/plan/capture.h"
#include "engine/scene/scene.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::render {

/// What dataset.json calls itself, under `format`.
inline constexpr const char* kDatasetFormat = "dollytrack dataset";

/// Everything dataset.json says that is not in the scene itself.
struct DatasetCard {
    std::string product_version;
    std::uint64_t seed = 0;
    nlohmann::json parameters;       // of planning, by section and name
    nlohmann::json planned_metrics;  // as planning estimated them, null when there are none
    CaptureMetrics counted;          // from the pixels
    std::vector<ObjectCapture> captures;
    CameraParams camera;
    std::vector<TrajectoryFrame> frames;         // of the dataset, in order
    std::vector<int> source_frames;              // their index in the trajectory
    std::map<std::string, std::string> sha256s;  // of every other file, by relative path
};

/// The text of dataset.json: which conventions the files follow, what they show, and how they came
/// to be. Holds no clock, so that equal input gives equal bytes.
[[nodiscard]] std::string datasetCardText(const Scene& scene, const DatasetCard& card);

}  // namespace dollytrack::render
