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

/// When a run of a SLAM program counts as a success.
struct SuccessLimits {
    double min_tracked = 0.8;  // share of the frames that have a pose
    double max_ate_m = 0.5;    // absolute trajectory error, RMSE
};

/// What one run has estimated, measured against the dataset.
struct RunFigures {
    std::string name;  // of its file
    TrajectoryError error;
    std::string not_measured;  // why there are no errors, in a sentence; empty where there are
    bool success = false;
    std::string cloud;  // of its point cloud; empty without one
    std::optional<CloudError> reconstruction;
    std::optional<double> completeness;
};

/// The dataset's own trajectory. Its motions are told apart where frames.csv tells.
Trajectory trueTrajectory(const verify::StoredDataset& dataset);

/// A file of timed poses. One without any pose is what a program leaves that never began to track:
/// an empty trajectory. Errors: BadInput, also for a file without times.
Result<Trajectory> readEstimate(const std::string& path);

/// Why an estimate has no errors; empty where it has.
std::string whyNotMeasured(const Trajectory& truth, const Trajectory& estimate,
                           const TrajectoryError& error, const TrajectoryErrorSettings& settings);

bool isSuccess(const TrajectoryError& error, const SuccessLimits& limits);

/// Share of the runs that are successes.
double successRate(const std::vector<RunFigures>& runs);

nlohmann::json evaluationJson(const std::vector<RunFigures>& runs, const SuccessLimits& limits);
std::string evaluationText(const std::vector<RunFigures>& runs, const SuccessLimits& limits,
                           const TrajectoryErrorSettings& settings);

}  // namespace dollytrack::cli
