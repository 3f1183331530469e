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
#include "render/dataset/contents/frame_folds.h"
#include "render/dataset/frame_range.h"
#include "render/gl/context.h"
#include "render/pictures/picture_quality.h"
#include "render/scene/object_motion.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Settings of an export.
struct DatasetSettings {
    std::filesystem::path folder;
    std::filesystem::path root;  // a parent folder; symbolic links below it are not followed;
                                 // empty: none
    FrameRange range;
    std::vector<std::string> modalities;  // names, see modalities.h; empty: the standard ones
    std::vector<std::string> formats;     // names, see formats/formats.h; empty: the standard ones
    bool overwrite = false;  // replaces a complete dataset once the new one is complete; allows
                             // foreign files
    bool resume = false;     // continues an unfinished export in the folder
    CaptureRules rules;
    double imu_rate_hz = 200.0;             // samples per second in imu.csv
    std::vector<int> flow_distances = {1};  // in frames of the dataset
    double stereo_baseline_m = 0.1;
    PictureParams picture;
    LightParams light;    // of the colour images
    SensorParams sensor;  // of rgb_sensor and depth_sensor
    ScoreWeights score;   // for the scores in frames.csv
    FoldSettings folds;   // for cross-validation
    Rig rig;              // additional cameras; if any, the modality `cameras` is written
};

/// Checks that all modality and format names are known and their requirements are met, except the
/// render mode. Returns Usage if not.
[[nodiscard]] Status checkChoices(const DatasetSettings& settings);

/// Checks what can be checked without the scene: names, and whether the folder can be written.
/// Errors as in DatasetJob::begin().
[[nodiscard]] Status checkSettings(const DatasetSettings& settings);

/// Origin of the trajectory as recorded in dataset.json, and the rooms to light.
struct DatasetOrigin {
    std::string product_version;
    std::uint64_t seed = 0;
    std::string parameters_json = "{}";         // of planning, by section and name
    std::string edits_json = "{}";              // manual edits, as in project files
    std::string planned_metrics_json = "null";  // as `plan --json` prints them
    std::vector<Eigen::AlignedBox3d> rooms;     // free-space components; may be empty
    /// Of the moving objects, by frame of the trajectory.
    std::vector<ObjectMotion> motions;
    std::vector<ObjectRelation> relations;
    std::string licenses;  // of the scene's models, clean text of several lines; may be empty
};

struct DatasetSummary {
    int frames = 0;
    CaptureMetrics counted;  // measured from the pixels
    PictureTally pictures;
    std::vector<ObjectCapture> captures;  // empty if the dataset was complete already
    std::filesystem::path contact_sheet;  // empty if no modality is an image
};

/// Renders a trajectory into a labelled dataset: call begin(), then step() until it returns false,
/// then finish(). Each step draws one frame, so a window can run it between its own frames. Without
/// finish() or after an error the folder contains whole images, the journal of finished frames and
/// no dataset.json, except that of an earlier dataset, which stays valid. A later job with `resume`
/// continues there and ends with the same bytes.
class DatasetJob {
  public:
    /// Checks and locks the folder, finds the results of an earlier export, bakes the light and
    /// uploads the scene. Scene, trajectory and rays must outlive the job. The job owns the
    /// context, which must be current. Returns Usage (unknown names, empty range, `resume` in a
    /// folder with frames of another dataset, a complete dataset without `resume` and `overwrite`),
    /// BadInput (`resume` of a damaged complete dataset), CannotWrite or Cancelled.
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
    /// Includes frames of an earlier export.
    [[nodiscard]] int framesDone() const;

    /// Draws one frame. Returns false if none was left.
    [[nodiscard]] Result<bool> step();

    /// Waits for the images and writes the other files, dataset.json last.
    [[nodiscard]] Result<DatasetSummary> finish();

    /// Instead of finish(), to stop early: completes the frames in progress and enters them in the
    /// journal. Returns the number of frames that need not be rendered again.
    int keep();

    /// Whether the folder on disk is still the one that begin() locked.
    [[nodiscard]] bool folderIsThere() const;

  private:
    struct Impl;
    explicit DatasetJob(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// Runs begin(), all steps and finish(), with progress and cancellation. If finished frames remain
/// after an error, the message says how many.
[[nodiscard]] Result<DatasetSummary> exportDataset(std::unique_ptr<gl::Context> context,
                                                   const Scene& scene, const RayCaster& rays,
                                                   const Trajectory& trajectory,
                                                   const CameraParams& camera,
                                                   DatasetSettings settings, DatasetOrigin origin,
                                                   const JobContext& job = {});

}  // namespace dollytrack::render
