#include "app/editor/project/quality_worker.h"

#include "engine/core/log.h"
#include "engine/geometry/ray_caster.h"
#include "planning/analysis/frame_quality.h"
#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"

#include <utility>

namespace dollytrack::editor {
namespace {

Result<FrameQuality> measure(const PlanOutcome& shown, const JobContext& job) {
    const planning::PlanParams& params = shown.params;
    const double radius_m = params.camera.camera_radius_m;
    const planning::AllowedRegion region(*shown.scene, *shown.rays, *shown.free_space,
                                         shown.edits.no_go, params.free_space, params.body,
                                         radius_m);
    const planning::SweptSphere sphere(*shown.rays, *shown.free_space, radius_m, &region);
    const planning::ViewEstimator views(*shown.scene, *shown.rays, params.camera);
    return planning::measureFrameQuality(
        {views, *shown.free_space, sphere, planning::pitchBand(params.constraints)}, params,
        *shown.plan, job);
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
    const bool can = shown.plan && shown.measured && shown.free_space && shown.rays;
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
