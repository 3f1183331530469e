#pragma once

#include "engine/plan/capture.h"
#include "engine/scene/scene.h"
#include "render/frames/frame_record.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Counts from the pixels which targets the frames show, and how well. Silhouettes cost drawing, so
/// it asks for one only where it can still change a result.
class CaptureCounter {
  public:
    explicit CaptureCounter(const Scene& scene, const CaptureRules& rules = {});

    /// Takes a frame's id image. Returns the objects whose silhouettes are needed, by id; their
    /// pixel counts must be handed to addSilhouettes() before the next frame.
    [[nodiscard]] std::vector<int> addFrame(const FrameRecord& frame);
    /// A frame whose picture is not `usable` captures nothing: it has no views then.
    void addSilhouettes(std::span<const std::uint64_t> whole_px, bool usable = true);

    /// Takes the views of a frame that was counted by an earlier run, in the place of the two
    /// above. In the same order of frames the counter then is as it was.
    void addCounted(std::span<const ObjectView> views);

    /// Ids of the targets the last frame shows well.
    [[nodiscard]] const std::vector<int>& wellShown() const { return well_shown_; }

    /// Views of the last frame.
    [[nodiscard]] std::span<const ObjectView> lastViews() const {
        return std::span(views_).subspan(last_views_);
    }

    /// Views that decide; those that can change nothing were left out.
    [[nodiscard]] const std::vector<ObjectView>& views() const { return views_; }

  private:
    [[nodiscard]] bool canMatter(const ObjectView& view) const;
    void take(const ObjectView& view);

    CaptureRules rules_;
    std::vector<bool> is_target_;         // by id
    std::vector<ObjectView> best_whole_;  // by id: largest view that shows all of the object
    std::vector<ObjectView> pending_;     // of the last frame, visible fraction still missing
    std::vector<double> pending_px_;      // their visible pixels
    std::vector<int> well_shown_;
    std::vector<ObjectView> views_;
    std::size_t last_views_ = 0;  // where those of the last frame begin
};

}  // namespace dollytrack::render
