#include "app/editor/project/quality_worker.h"

#include "engine/core/log.h"
#include "planning/analysis/frame_quality.h"
#include "planning/pipeline/search_environment.h"

#include <utility>

namespace dollytrack::editor {
namespace {

Result<FrameQuality> measure(const PlanOutcome& shown, const JobContext& job) {
    const planning::SearchEnvironment search(
        {shown.scene, shown.rays, shown.free_space, shown.region}, shown.params);
    return planning::measureFrameQuality(search.environment(), shown.params, *shown.plan, job);
}

}  // namespace

void QualityWorker::follow(const PlanOutcome& shown, bool wanted) {
    if (std::optional<Answer> answer = answers_->take()) {
        measured_plan_ = std::move(answer->plan);
        quality_ = std::move(answer->quality);
    }
    if (shown.plan != measured_plan_) {
        measured_plan_.reset();
        quality_.reset();
    }
    const bool can = shown.plan && shown.measured;
    if (!wanted || !can) {
        if (worker_.state().busy) worker_.cancel();
        asked_plan_ = measured_plan_;
        return;
    }
    if (shown.plan == asked_plan_) return;
    asked_plan_ = shown.plan;
    worker_.start([shown, latest = answers_](const JobContext& job) {
        Result<FrameQuality> quality = measure(shown, job);
        if (quality) {
            latest->put({shown.plan, std::make_shared<const FrameQuality>(std::move(*quality))});
        } else if (quality.error().code != ErrorCode::Cancelled) {
            log::error("frames", describe(quality.error()));
        }
    });
}

}  // namespace dollytrack::editor
