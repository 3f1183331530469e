#pragma once

#include "engine/camera/picture_params.h"
#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "render/dataset/dataset_contents.h"
#include "render/draw/scene_renderer.h"
#include "render/draw/surface_target.h"
#include "render/frames/capture_counter.h"
#include "render/frames/frame_context.h"
#include "render/frames/frame_ledger.h"
#include "render/frames/frame_record.h"
#include "render/light/frame_lights.h"
#include "render/light/frame_reflections.h"
#include "render/pathtrace/reference_pictures.h"
#include "render/rig/rig_pictures.h"
#include "render/sensors/sensor_pictures.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// Draws the frames of a dataset that are missing, one a call, counts what all frames show, and
/// hands the images on. Needs its OpenGL context current, to the end.
class FramePipeline {
  public:
    /// `restored`: the views of the frames that need not be drawn. `needs`: bits of FrameNeeds.
    /// `context` must outlive this.
    FramePipeline(const FrameContext& context, const CaptureRules& rules, unsigned needs,
                  const PictureParams& picture, std::map<int, std::vector<ObjectView>> restored);

    /// Computes the light and loads the scene, where there is anything to draw. The job can cancel
    /// frames, too.
    /// `objects` are needed where the sensor's light is, and outlive this.
    [[nodiscard]] Status prepare(const RayCaster& rays,
                                 const std::vector<Eigen::AlignedBox3d>& rooms,
                                 const ObjectPaths* objects, const JobContext& job);

    [[nodiscard]] int frameCount() const { return static_cast<int>(contents_.frames.size()); }
    [[nodiscard]] int missingCount() const { return static_cast<int>(missing_.size()); }
    [[nodiscard]] int doneCount() const {
        return frameCount() - missingCount() + static_cast<int>(drawn_);
    }

    /// Where the images of a frame go.
    using TakeFrame = std::function<Status(FrameRecord)>;

    /// Draws the next missing frame; there must be one. Without a ledger, nothing is counted.
    [[nodiscard]] Status drawNext(const TakeFrame& take, FrameLedger* ledger);

    /// Counts the last frame drawn, whose silhouettes are still on their way.
    [[nodiscard]] Status countLast(FrameLedger* ledger);

    /// What decides about captures, from all frames; when all are drawn and counted.
    [[nodiscard]] const std::vector<ObjectView>& views();

  private:
    [[nodiscard]] View viewOf(int index) const;
    [[nodiscard]] FrameRecord emptyRecord(int index) const;
    void countRestored(int before);
    /// Puts the things that move where they are in the frame.
    void placeObjects(int index);
    /// Where frames differ in light.
    void lightFrame(int index);
    [[nodiscard]] Status startNext();
    /// What is drawn for some files only.
    [[nodiscard]] Status drawMore(const View& view, FrameRecord& record);
    /// Returns the silhouettes' pixel counts that the counter wants.
    [[nodiscard]] Result<std::vector<std::uint64_t>> drawInstances(const View& view,
                                                                   FrameRecord& record,
                                                                   const std::vector<int>& wanted);
    /// Counts what a frame captures, when its picture is there.
    [[nodiscard]] Status count(int index, std::span<const std::uint64_t> silhouettes_px,
                               FrameLedger* ledger);
    [[nodiscard]] Status drawRig(FrameRecord& record);
    [[nodiscard]] bool needs(unsigned what) const { return (needs_ & what) != 0; }

    const FrameContext& context_;
    const DatasetContents& contents_;
    unsigned needs_;
    std::optional<SceneRenderer> renderer_;
    // Two, so that one frame's triangles are set up while the other's pixels are still computed.
    std::array<std::optional<RenderTarget>, 2> targets_;
    std::array<std::optional<SurfaceTarget>, 2> surfaces_;  // over them, where they are wanted
    std::optional<RenderTarget> right_;
    std::optional<LensPictures> rig_;
    PictureParams picture_;
    std::optional<FrameLights> lights_;
    std::optional<FrameReflections> reflections_;
    int lit_for_ = -1;  // the frame whose light the renderer has, where they differ
    std::optional<ReferencePictures> reference_;  // where they are wanted
    std::optional<SensorPictures> sensor_;        // likewise
    CaptureCounter counter_;
    std::map<int, std::vector<ObjectView>> restored_;
    std::vector<int> missing_;  // indices of frames
    std::size_t started_ = 0;   // of those missing
    std::size_t drawn_ = 0;
    int silhouettes_of_ = -1;                // the frame whose silhouettes are being drawn
    std::optional<PictureQuality> quality_;  // of the last picture drawn
    int restored_until_ = 0;                 // the frames below are counted, if they were restored
};

}  // namespace dollytrack::render
