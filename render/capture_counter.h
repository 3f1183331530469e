#pragma once

#include "engine/plan/capture.h"
#include "engine/scene/scene.h"
#include "render/frame_record.h"

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
    void addSilhouettes(std::span<const std::uint64_t> whole_px);

    /// Names of the targets the last frame shows well, by id.
    [[nodiscard]] const std::vector<int>& wellShown() const { return well_shown_; }

    /// Views that decide; those that can change nothing were left out.
    [[nodiscard]] const std::vector<ObjectView>& views() const { return views_; }

  private:
    [[nodiscard]] bool canMatter(const ObjectView& view) const;

    CaptureRules rules_;
    std::vector<bool> is_target_;         // by id
    std::vector<ObjectView> best_whole_;  // by id: largest view that shows all of the object
    std::vector<ObjectView> pending_;     // of the last frame, visible fraction still missing
    std::vector<double> pending_px_;      // their visible pixels
    std::vector<int> well_shown_;
    std::vector<ObjectView> views_;
};

}  // namespace dollytrack::render
