#pragma once

#include "engine/plan/frame_quality.h"
#include "engine/plan/plan.h"
#include "engine/scene/scene.h"
#include "planning/motions/colliding_frames.h"
#include "ui/panels/timeline/timeline_panel.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dollytrack::editor {

/// Timeline data of a plan, computed once per plan; and the values of the plan before, to be shown
/// until the new ones are measured.
class PlanTimeline {
  public:
    /// Updates the data; returns whether the plan (null: none) differs from the last call. `rays`
    /// are those of the scene; without them no collisions are found.
    bool follow(const Scene* scene, const RayCaster* rays, std::shared_ptr<const Plan> plan,
                double camera_radius_m);
    /// Metrics of the newest measured plan; null if no plan was measured.
    [[nodiscard]] const FrameSeries* measured() const {
        return measured_ ? &measured_->series : nullptr;
    }
    /// Sets the quality of the shown plan's frames; null: not measured. `pending`: it will be.
    void followQuality(std::shared_ptr<const FrameQuality> quality, bool pending);
    /// The newest quality, of the shown plan or an earlier one; null if there is none, or the last
    /// call of followQuality() expects none.
    [[nodiscard]] const FrameQuality* measuredQuality() const { return quality_.get(); }
    [[nodiscard]] bool qualityPending() const { return quality_pending_; }
    [[nodiscard]] const std::vector<ui::TimelineKey>& keys() const { return keys_; }
    [[nodiscard]] const std::vector<ui::TimelineBand>& bands() const { return bands_; }
    /// The collisions of a given motion.
    [[nodiscard]] const std::vector<planning::CollidingFrames>& collisions() const {
        return collisions_;
    }
    [[nodiscard]] const std::vector<double>& times() const { return times_s_; }
    /// Increases with every plan.
    [[nodiscard]] std::uint64_t serial() const { return serial_; }

  private:
    std::shared_ptr<const Plan> seen_;  // held, so that its address is not reused
    std::shared_ptr<const Plan> measured_;
    std::shared_ptr<const FrameQuality> quality_;
    bool quality_pending_ = false;
    std::uint64_t serial_ = 0;
    std::vector<double> times_s_;  // times of the frames
    std::vector<planning::CollidingFrames> collisions_;
    std::vector<ui::TimelineKey> keys_;
    std::vector<ui::TimelineBand> bands_;
};

}  // namespace dollytrack::editor
