#pragma once

#include "engine/plan/plan.h"
#include "engine/scene/scene.h"
#include "ui/panels/timeline/timeline_panel.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dollytrack::editor {

/// Timeline data of a plan, computed once per plan.
class PlanTimeline {
  public:
    /// Updates the data; returns whether the plan (null: none) differs from the last call.
    bool follow(const Scene* scene, std::shared_ptr<const Plan> plan);
    /// Metrics of the newest measured plan; null if no plan was measured.
    [[nodiscard]] const FrameSeries* measured() const {
        return measured_ ? &measured_->series : nullptr;
    }
    [[nodiscard]] const std::vector<ui::TimelineKey>& keys() const { return keys_; }
    [[nodiscard]] const std::vector<ui::TimelineBand>& bands() const { return bands_; }
    [[nodiscard]] const std::vector<double>& times() const { return times_s_; }
    /// Increases with every plan.
    [[nodiscard]] std::uint64_t serial() const { return serial_; }

  private:
    std::shared_ptr<const Plan> seen_;  // held, so that its address is not reused
    std::shared_ptr<const Plan> measured_;
    std::uint64_t serial_ = 0;
    std::vector<double> times_s_;  // times of the frames
    std::vector<ui::TimelineKey> keys_;
    std::vector<ui::TimelineBand> bands_;
};

}  // namespace dollytrack::editor
