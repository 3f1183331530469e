#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/picture_params.h"
#include "engine/camera/rig.h"
#include "engine/camera/sensor_params.h"
#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/plan/capture.h"
#include "engine/plan/image_score.h"
#include "engine/scene/light_params.h"
#include "engine/scene/scene.h"
#include "render/dataset/frame_folds.h"
#include "render/dataset/frame_range.h"
#include "render/dataset/picture_quality.h"
#include "render/frames/object_motion.h"
#include "render/gl/context.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Where a dataset goes and how much of the trajectory it holds.
struct DatasetSettings {
    std::filesystem::path folder;
    std::filesystem::path root;  // a folder around it, below which no link is followed; empty: none
    FrameRange range;
    std::vector<std::string> modalities;  // names of modalities.h; empty: the standard ones
    std::vector<std::string> formats;     // names of formats/formats.h; likewise
    bool overwrite = false;  // replaces a complete dataset when the new one is; allows other files
    bool resume = false;     // continues what an export left in the folder
    CaptureRules rules;
    double imu_rate_hz = 200.0;             // samples a second in imu.csv
    std::vector<int> flow_distances = {1};  // in frames of the dataset
    double stereo_baseline_m = 0.1;
    PictureParams picture;
    LightParams light;    // of colour pictures
    SensorParams sensor;  // of rgb_sensor and depth_sensor
    ScoreWeights score;   // of the scores in frames.csv
    FoldSettings folds;   // for cross-validation
    Rig rig;              // further cameras; with any, the modality `cameras` is written
};

/// Whether all names are known, and what they need is there. Errors: Usage.
[[nodiscard]] Status checkChoices(const DatasetSettings& settings);

/// Whether an export with these settings could begin, as far as can be said without the scene:
/// names, and whether the folder can be written. Errors as DatasetJob::begin().
[[nodiscard]] Status checkSettings(const DatasetSettings& settings);

/// What dataset.json says of how the trajectory came to be, and what lights its rooms.
struct DatasetOrigin {
    std::string product_version;
    std::uint64_t seed = 0;
    std::string parameters_json = "{}";         // of planning, by section and name
    std::string edits_json = "{}";              // made by hand, as projects keep them
    std::string planned_metrics_json = "null";  // as `plan --json` prints them
    std::vector<Eigen::AlignedBox3d> rooms;     // by free-space component; may be empty
    /// Of the objects that move, by frame of the trajectory.
    std::vector<ObjectMotion> motions;
    std::vector<ObjectRelation> relations;
};

struct DatasetSummary {
    int frames = 0;
    CaptureMetrics counted;  // from the pixels
    PictureTally pictures;
    std::vector<ObjectCapture> captures;  // empty when nothing was left to do
    std::filesystem::path contact_sheet;  // empty where no modality is a picture
};

/// Renders a trajectory into a labelled dataset: begin, step() until it returns false, finish().
/// Each step draws one frame, so a window can run it between its own frames. Without finish(), or
/// after an error, what is in the folder are whole images, the journal of those that are finished,
/// and no dataset.json but that of an earlier dataset, which is still whole; a later job with
/// `resume` continues there and ends with the same bytes.
class DatasetJob {
  public:
    /// Checks and locks the folder, finds what an earlier export left, computes the light and loads
    /// the scene. Scene, trajectory and rays must outlive the job. The job owns the context, which
    /// must be current. Errors: Usage (names, range; `resume` where the folder holds frames of
    /// something else; a complete dataset without `resume` and `overwrite`), BadInput (`resume`
    /// where a complete dataset was damaged), CannotWrite, Cancelled.
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
    /// Those of an earlier export included.
    [[nodiscard]] int framesDone() const;

    /// Draws one frame; false when there was none left.
    [[nodiscard]] Result<bool> step();

    /// Waits for the images and writes the other files, dataset.json last.
    [[nodiscard]] Result<DatasetSummary> finish();

    /// In the place of finish(), to stop early: lets the frames on their way be finished and
    /// entered in the journal. How many need not be rendered again.
    int keep();

    /// Whether nobody has taken the folder away since begin().
    [[nodiscard]] bool folderIsThere() const;

  private:
    struct Impl;
    explicit DatasetJob(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// begin, every step and finish in one call, with progress and cancelling. Errors that leave
/// finished frames behind say how many.
[[nodiscard]] Result<DatasetSummary> exportDataset(std::unique_ptr<gl::Context> context,
                                                   const Scene& scene, const RayCaster& rays,
                                                   const Trajectory& trajectory,
                                                   const CameraParams& camera,
                                                   DatasetSettings settings, DatasetOrigin origin,
                                                   const JobContext& job = {});

}  // namespace dollytrack::render
