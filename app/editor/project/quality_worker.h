#pragma once

#include "app/editor/project/live_planner.h"
#include "engine/jobs/background_worker.h"
#include "engine/plan/frame_quality.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace dollytrack::editor {

/// Computes the FrameQuality of the shown plan in the background, once for each plan and only while
/// it is requested.
class QualityWorker {
  public:
    explicit QualityWorker(std::function<void()> wake) : worker_(std::move(wake)) {}

    /// To be called every frame: starts or cancels the measurement, and takes its result.
    void follow(const PlanOutcome& shown, bool wanted);
    /// The measurement of this plan; null if there is none yet.
    [[nodiscard]] std::shared_ptr<const FrameQuality> of(
        const std::shared_ptr<const Plan>& plan) const {
        return plan && plan == measured_plan_ ? quality_ : nullptr;
    }
    [[nodiscard]] BackgroundWorker::State state() const { return worker_.state(); }

  private:
    struct Answer {
        std::shared_ptr<const Plan> plan;
        std::shared_ptr<const FrameQuality> quality;
    };

    std::shared_ptr<const Plan> asked_plan_;  // being measured, or measured
    std::shared_ptr<const Plan> measured_plan_;
    std::shared_ptr<const FrameQuality> quality_;
    std::shared_ptr<LatestValue<Answer>> answers_ = std::make_shared<LatestValue<Answer>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
