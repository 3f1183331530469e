#pragma once

#include "engine/plan/capture.h"
#include "engine/scene/scene.h"
#include "render/frames/frame_record.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Determines from id images which targets the frames capture, and how well. Silhouettes cost
/// drawing time, so they are requested only where they can still change a result.
class CaptureCounter {
  public:
    explicit CaptureCounter(const Scene& scene, const CaptureRules& rules = {});

    /// Counts a frame's id image. Returns the ids of objects whose silhouettes are needed; pass
    /// their pixel counts to addSilhouettes() before the next frame.
    [[nodiscard]] std::vector<int> addFrame(const FrameRecord& frame);
    /// `whole_px` holds silhouette areas in the order of addFrame()'s ids. A frame with an unusable
    /// image captures nothing and adds no views.
    void addSilhouettes(std::span<const std::uint64_t> whole_px, bool usable = true);

    /// Adds a frame that an earlier run counted, instead of the two functions above. If frames come
    /// in the same order, the counter's state is the same.
    void addCounted(std::span<const ObjectView> views);

    /// Ids of the targets that the last frame shows well.
    [[nodiscard]] const std::vector<int>& wellShown() const { return well_shown_; }

    /// Views (visibility and size of targets) of the last frame.
    [[nodiscard]] std::span<const ObjectView> lastViews() const {
        return std::span(views_).subspan(last_views_);
    }

    /// Views of all frames that affect the result; views that cannot change it are left out.
    [[nodiscard]] const std::vector<ObjectView>& views() const { return views_; }

  private:
    [[nodiscard]] bool canMatter(const ObjectView& view) const;
    void take(const ObjectView& view);

    CaptureRules rules_;
    std::vector<bool> is_target_;         // by id
    std::vector<ObjectView> best_whole_;  // by id: largest view that shows the whole object
    std::vector<ObjectView> pending_;     // views of the last frame, without visible fraction
    std::vector<double> pending_px_;      // their visible pixels
    std::vector<int> well_shown_;
    std::vector<ObjectView> views_;
    std::size_t last_views_ = 0;  // index of the last frame's first view
};

}  // namespace dollytrack::render
