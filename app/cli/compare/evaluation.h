#pragma once

#include "engine/camera/trajectory_error.h"
#include "engine/core/result.h"
#include "engine/geometry/cloud_error.h"
#include "render/verify/read/stored_dataset.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::cli {

/// Conditions for a successful SLAM run.
struct SuccessLimits {
    double min_tracked = 0.8;  // minimum fraction of frames with a pose
    double max_ate_m = 0.5;    // maximum absolute trajectory error (RMSE), m
};

/// Errors of one SLAM run with respect to the dataset.
struct RunFigures {
    std::string name;  // file name of the trajectory
    TrajectoryError error;
    std::string not_measured;  // why there are no errors; empty if there are
    bool success = false;
    std::string cloud;  // file name of its point cloud; empty: none
    std::optional<CloudError> reconstruction;
    std::optional<double> completeness;
};

/// The ground-truth trajectory of the dataset. Separate motions are distinguished if frames.csv has
/// the column `path`.
Trajectory trueTrajectory(const verify::StoredDataset& dataset);

/// Reads a file of timed poses. A file without poses, which a program leaves if it never started
/// tracking, gives an empty trajectory. Error: BadInput, also if the poses have no times.
Result<Trajectory> readEstimate(const std::string& path);

/// Why an estimate has no errors; empty if it has.
std::string whyNotMeasured(const Trajectory& truth, const Trajectory& estimate,
                           const TrajectoryError& error, const TrajectoryErrorSettings& settings);

bool isSuccess(const TrajectoryError& error, const SuccessLimits& limits);

/// Fraction of successful runs; 0 if there are no runs.
double successRate(const std::vector<RunFigures>& runs);

nlohmann::json evaluationJson(const std::vector<RunFigures>& runs, const SuccessLimits& limits);
std::string evaluationText(const std::vector<RunFigures>& runs, const SuccessLimits& limits,
                           const TrajectoryErrorSettings& settings);

}  // namespace dollytrack::cli
