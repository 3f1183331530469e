#pragma once

#include "render/dataset/dataset_job.h"
#include "render/dataset/dataset_order.h"
#include "render/frames/frame_context.h"
#include "render/frames/frame_pipeline.h"
#include "render/frames/moving_objects.h"
#include "render/sensors/object_paths.h"
#include "render/sensors/sensor_lens.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// What the frames of a dataset are drawn with: the part of an export that knows no folder.
struct FrameDrawing {
    DatasetSettings settings;
    std::unique_ptr<const Scene> varied;  // where materials vary; `order` is of it then
    DatasetOrder order;

    // In this order, so that OpenGL's things go before the context they live in.
    std::unique_ptr<gl::Context> context;
    std::optional<MovingObjects> moving;
    std::optional<ObjectPaths> object_paths;  // where the sensor's pictures are wanted
    std::optional<SensorLens> sensor_lens;
    std::optional<FrameContext> frame_context;
    std::optional<FramePipeline> pipeline;

    /// The scene's materials as the light has them; null where they do not vary.
    static std::unique_ptr<const Scene> variedScene(const Scene& scene, const LightParams& light);

    FrameDrawing(DatasetSettings set, std::unique_ptr<const Scene> changed, DatasetOrder wanted)
        : settings(std::move(set)), varied(std::move(changed)), order(std::move(wanted)) {}
    ~FrameDrawing();
    FrameDrawing(const FrameDrawing&) = delete;
    FrameDrawing& operator=(const FrameDrawing&) = delete;

    /// Bits of FrameNeeds.
    [[nodiscard]] unsigned needs() const;

    /// Computes the light and loads the scene. Trajectory and rays are those of the order; the rays
    /// must outlive this. `restored`: the views of the frames that need not be drawn.
    Status prepare(const RayCaster& rays, const Trajectory& trajectory, const DatasetOrigin& origin,
                   std::map<int, std::vector<ObjectView>> restored, const JobContext& job);
};

/// Draws the frames of a trajectory one after the other and keeps nothing: an export's images
/// without its files. Needs no folder; its settings' formats are left out.
class FrameSeries {
  public:
    /// As DatasetJob::begin(). Errors: Usage, NoOpenGl, Cancelled.
    [[nodiscard]] static Result<FrameSeries> begin(std::unique_ptr<gl::Context> context,
                                                   const Scene& scene, const RayCaster& rays,
                                                   const Trajectory& trajectory,
                                                   const CameraParams& camera,
                                                   DatasetSettings settings, DatasetOrigin origin,
                                                   const JobContext& job = {});

    [[nodiscard]] const DatasetContents& contents() const { return drawing_->order.contents; }

    /// The next frame, its classes labelled; none after the last one.
    [[nodiscard]] Result<std::optional<FrameRecord>> next();

  private:
    explicit FrameSeries(std::unique_ptr<FrameDrawing> drawing) : drawing_(std::move(drawing)) {}
    std::unique_ptr<FrameDrawing> drawing_;
};

}  // namespace dollytrack::render
