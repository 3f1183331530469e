#pragma once

#include "render/dataset/contents/frame_context.h"
#include "render/dataset/dataset_job.h"
#include "render/dataset/dataset_order.h"
#include "render/pipeline/frame_pipeline.h"
#include "render/scene/moving_objects.h"
#include "render/scene/object_paths.h"
#include "render/sensors/sensor_lens.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// Everything that frames of a dataset are drawn with, independent of any output folder.
struct FrameDrawing {
    DatasetSettings settings;
    std::unique_ptr<const Scene> varied;  // scene with varied materials; `order` then refers to it
    DatasetOrder order;

    // Declared in this order so that OpenGL objects are destroyed before their context.
    std::unique_ptr<gl::Context> context;
    std::optional<MovingObjects> moving;
    std::optional<ObjectPaths> object_paths;  // only with modality rgb_sensor
    std::optional<SensorLens> sensor_lens;
    std::optional<FrameContext> frame_context;
    std::optional<FramePipeline> pipeline;

    /// A copy of the scene with varied materials; null if they do not vary.
    static std::unique_ptr<const Scene> variedScene(const Scene& scene, const LightParams& light);

    FrameDrawing(DatasetSettings set, std::unique_ptr<const Scene> changed, DatasetOrder wanted)
        : settings(std::move(set)), varied(std::move(changed)), order(std::move(wanted)) {}
    ~FrameDrawing();
    FrameDrawing(const FrameDrawing&) = delete;
    FrameDrawing& operator=(const FrameDrawing&) = delete;

    /// Bits of FrameNeeds.
    [[nodiscard]] unsigned needs() const;

    /// Bakes the light and uploads the scene. `rays` and `trajectory` must be those of the order;
    /// `rays` must outlive this object. `restored`: views of the frames that need not be drawn.
    Status prepare(const RayCaster& rays, const Trajectory& trajectory, const DatasetOrigin& origin,
                   std::map<int, std::vector<ObjectView>> restored, const JobContext& job);
};

/// Draws the frames of a trajectory one after the other without writing files. The settings' folder
/// and formats are ignored.
class FrameSeries {
  public:
    /// As DatasetJob::begin(), without a folder. Returns Usage, NoOpenGl or Cancelled.
    [[nodiscard]] static Result<FrameSeries> begin(std::unique_ptr<gl::Context> context,
                                                   const Scene& scene, const RayCaster& rays,
                                                   const Trajectory& trajectory,
                                                   const CameraParams& camera,
                                                   DatasetSettings settings, DatasetOrigin origin,
                                                   const JobContext& job = {});

    [[nodiscard]] const DatasetContents& contents() const { return drawing_->order.contents; }

    /// The next frame with class labels; none after the last.
    [[nodiscard]] Result<std::optional<FrameRecord>> next();

  private:
    explicit FrameSeries(std::unique_ptr<FrameDrawing> drawing) : drawing_(std::move(drawing)) {}
    std::unique_ptr<FrameDrawing> drawing_;
};

}  // namespace dollytrack::render
