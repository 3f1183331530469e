#pragma once

#include "engine/plan/plan.h"
#include "engine/scene/scene.h"
#include "ui/panels/timeline/timeline_panel.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dollytrack::editor {

/// What the timeline shows of a plan, made once for each.
class PlanTimeline {
  public:
    /// Whether the plan (null: there is none) is another than at the last call.
    bool follow(const Scene* scene, std::shared_ptr<const Plan> plan);
    /// What was measured of the newest plan of which that is known; null: of none.
    [[nodiscard]] const FrameSeries* measured() const {
        return measured_ ? &measured_->series : nullptr;
    }
    [[nodiscard]] const std::vector<ui::TimelineKey>& keys() const { return keys_; }
    [[nodiscard]] const std::vector<ui::TimelineBand>& bands() const { return bands_; }
    [[nodiscard]] const std::vector<double>& times() const { return times_s_; }
    /// Rises with every plan.
    [[nodiscard]] std::uint64_t serial() const { return serial_; }

  private:
    std::shared_ptr<const Plan> seen_;  // held, so that no other plan gets its address
    std::shared_ptr<const Plan> measured_;
    std::uint64_t serial_ = 0;
    std::vector<double> times_s_;  // of the frames
    std::vector<ui::TimelineKey> keys_;
    std::vector<ui::TimelineBand> bands_;
};

}  // namespace dollytrack::editor
