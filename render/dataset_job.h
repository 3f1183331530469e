#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/plan/capture.h"
#include "engine/scene/scene.h"
#include "render/gl/context.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Frames begin, begin + step, ... below end of a trajectory; no end: to the last.
struct FrameRange {
    int begin = 0;
    std::optional<int> end;
    int step = 1;
};

/// "a:b:s" with every part optional ("10:", ":50", "::5"). Usage error otherwise.
[[nodiscard]] Result<FrameRange> parseFrameRange(const std::string& text);

/// Where a dataset goes and how much of the trajectory it holds.
struct DatasetSettings {
    std::filesystem::path folder;
    FrameRange range;
    bool overwrite = false;  // allows a folder that holds other files; they stay
    CaptureRules rules;
};

/// What dataset.json says of how the trajectory came to be, and what lights its rooms.
struct DatasetOrigin {
    std::string product_version;
    std::uint64_t seed = 0;
    std::string parameters_json = "{}";         // of planning, by section and name
    std::string planned_metrics_json = "null";  // as `plan --json` prints them
    std::vector<Eigen::AlignedBox3d> rooms;     // by free-space component; may be empty
};

struct DatasetSummary {
    int frames = 0;
    CaptureMetrics counted;  // from the pixels
    std::vector<ObjectCapture> captures;
    std::filesystem::path contact_sheet;
};

/// Renders a trajectory into a labelled dataset: begin, step() until it returns false, finish().
/// Each step draws one frame, so a window can run it between its own frames. Without finish(), or
/// after an error, what is in the folder are whole images and no dataset.json.
class DatasetJob {
  public:
    /// Checks the folder, computes the light and loads the scene. Scene, trajectory and rays must
    /// outlive the job. The job owns the context, which must be current.
    [[nodiscard]] static Result<DatasetJob> begin(std::unique_ptr<gl::Context> context,
                                                  const Scene& scene, const RayCaster& rays,
                                                  const Trajectory& trajectory,
                                                  const CameraParams& camera,
                                                  DatasetSettings settings, DatasetOrigin origin,
                                                  const JobContext& job = {});
    ~DatasetJob();
    DatasetJob(DatasetJob&&) noexcept;
    DatasetJob& operator=(DatasetJob&&) noexcept;

    [[nodiscard]] int frameCount() const;
    [[nodiscard]] int framesDone() const;

    /// Draws one frame; false when there was none left.
    [[nodiscard]] Result<bool> step();

    /// Waits for the images and writes the other files, dataset.json last.
    [[nodiscard]] Result<DatasetSummary> finish();

  private:
    struct Impl;
    explicit DatasetJob(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// begin, every step and finish in one call, with progress and cancelling.
[[nodiscard]] Result<DatasetSummary> exportDataset(std::unique_ptr<gl::Context> context,
                                                   const Scene& scene, const RayCaster& rays,
                                                   const Trajectory& trajectory,
                                                   const CameraParams& camera,
                                                   DatasetSettings settings, DatasetOrigin origin,
                                                   const JobContext& job = {});

}  // namespace dollytrack::render
