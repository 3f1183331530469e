#pragma once

#include "engine/core/result.h"
#include "engine/plan/plan.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack {

/// Counts and rates of captured objects under their published names, whoever counted them.
nlohmann::json captureMetricsJson(const CaptureMetrics& metrics);

/// The inverse, as a dataset's card holds it. Error: BadInput.
Result<CaptureMetrics> captureMetricsFromJson(const nlohmann::json& json);

/// The metrics of a plan under their published names, for `--json` and dataset.json: object
/// counts, rates (0..1), stage times, path length, frames, the uncaptured objects with reasons, and
/// the capture ledger.
nlohmann::json metricsJson(const Scene& scene, const Plan& plan);

/// The same with the dense search's rates, when it was made, and the names of the objects that it
/// captures (well) but the plan in `metrics` does not.
void addBound(nlohmann::json& metrics, const CaptureBound& bound, double milliseconds);

/// Poses as position and quaternion (x, y, z, w), world_from_camera, full precision.
nlohmann::json trajectoryJson(const Trajectory& trajectory);

/// Error: BadInput when a field is missing, of the wrong type, or no finite pose.
Result<Trajectory> trajectoryFromJson(const nlohmann::json& json);

/// Metrics without what differs from run to run, the times: for files that must repeat exactly.
nlohmann::json withoutTimes(nlohmann::json metrics);

/// The result section of a project: metrics without times, rooms, trajectory, observation and
/// position points, paths.
nlohmann::json resultJson(const Scene& scene, const Plan& plan);

/// The rooms of a result section. Error: BadInput.
Result<std::vector<Eigen::AlignedBox3d>> roomsFromJson(const nlohmann::json& result);

}  // namespace dollytrack
