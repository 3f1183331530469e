#pragma once

#include "engine/camera/picture_params.h"
#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "render/dataset/contents/dataset_contents.h"
#include "render/dataset/contents/frame_context.h"
#include "render/draw/passes/surface_target.h"
#include "render/draw/scene_renderer.h"
#include "render/frames/frame_record.h"
#include "render/light/frame_lights.h"
#include "render/pipeline/capture_counter.h"
#include "render/pipeline/frame_ledger.h"
#include "render/pipeline/frame_reflections.h"
#include "render/pipeline/sensor_pictures.h"
#include "render/pipeline/traced_pictures.h"
#include "render/rig/rig_pictures.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// Draws the missing frames of a dataset, one per call, counts the captures of all frames and
/// passes the images on. Its OpenGL context must be current for every call.
class FramePipeline {
  public:
    /// @param restored  views of the frames that need not be drawn, by index
    /// @param needs     bits of FrameNeeds
    ///
    /// `context` must outlive this object.
    FramePipeline(const FrameContext& context, const CaptureRules& rules, unsigned needs,
                  const PictureParams& picture, std::map<int, std::vector<ObjectView>> restored);

    /// Bakes the light and uploads the scene, unless no frame is missing. `objects` is required
    /// with kNeedsSensorLight and must outlive this object. `job` can cancel path-traced frames,
    /// too.
    [[nodiscard]] Status prepare(const RayCaster& rays,
                                 const std::vector<Eigen::AlignedBox3d>& rooms,
                                 const ObjectPaths* objects, const JobContext& job);

    [[nodiscard]] int frameCount() const { return static_cast<int>(contents_.frames.size()); }
    [[nodiscard]] int missingCount() const { return static_cast<int>(missing_.size()); }
    [[nodiscard]] int doneCount() const {
        return frameCount() - missingCount() + static_cast<int>(drawn_);
    }

    /// Receives a frame's images.
    using TakeFrame = std::function<Status(FrameRecord)>;

    /// Draws the next missing frame; there must be one. Without a ledger no captures are counted.
    [[nodiscard]] Status drawNext(const TakeFrame& take, FrameLedger* ledger);

    /// Counts the captures of the last frame drawn, whose silhouettes may still be pending.
    [[nodiscard]] Status countLast(FrameLedger* ledger);

    /// Views that affect captures, of all frames. Call it after all frames are drawn and counted.
    [[nodiscard]] const std::vector<ObjectView>& views();

  private:
    [[nodiscard]] View viewOf(int index) const;
    [[nodiscard]] FrameRecord emptyRecord(int index) const;
    void countRestored(int before);
    /// Moves the moving objects to their positions in the frame.
    void placeObjects(int index);
    /// Applies the frame's light and reflections, if they vary.
    void lightFrame(int index);
    [[nodiscard]] Status startNext();
    /// Draws images that only some files need.
    [[nodiscard]] Status drawMore(const View& view, FrameRecord& record);
    /// Draws amodal masks and silhouettes. Returns the silhouette areas of the ids in `wanted`.
    [[nodiscard]] Result<std::vector<std::uint64_t>> drawInstances(const View& view,
                                                                   FrameRecord& record,
                                                                   const std::vector<int>& wanted);
    /// Counts a frame's captures once the quality of its image is known.
    [[nodiscard]] Status count(int index, std::span<const std::uint64_t> silhouettes_px,
                               FrameLedger* ledger);
    [[nodiscard]] Status drawRig(FrameRecord& record);
    [[nodiscard]] bool needs(unsigned what) const { return (needs_ & what) != 0; }

    const FrameContext& context_;
    const DatasetContents& contents_;
    unsigned needs_;
    std::optional<SceneRenderer> renderer_;
    // Two targets, so that one frame's triangles are processed while the other's pixels are shaded.
    std::array<std::optional<RenderTarget>, 2> targets_;
    std::array<std::optional<SurfaceTarget>, 2> surfaces_;  // parallel to targets_; only with
                                                            // kNeedsSurfaces
    std::optional<RenderTarget> right_;
    std::optional<LensPictures> rig_;
    PictureParams picture_;
    std::optional<FrameLights> lights_;
    std::optional<FrameReflections> reflections_;
    int lit_for_ = -1;                      // frame whose light the renderer has, if light varies
    std::optional<TracedPictures> traced_;  // only for path-traced images
    std::optional<SensorPictures> sensor_;  // only with kNeedsSensorLight
    CaptureCounter counter_;
    std::map<int, std::vector<ObjectView>> restored_;
    std::vector<int> missing_;  // frame indices
    std::size_t started_ = 0;   // number of missing frames whose drawing has started
    std::size_t drawn_ = 0;
    int silhouettes_of_ = -1;                // frame whose silhouettes are pending, -1: none
    std::optional<PictureQuality> quality_;  // of the last image drawn
    int restored_until_ = 0;                 // restored frames below this index are counted
};

}  // namespace dollytrack::render
