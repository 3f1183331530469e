#include "app/editor/timeline/plan_timeline.h"

#include "ui/panels/timeline/timeline_data.h"

#include <utility>

namespace dollytrack::editor {

bool PlanTimeline::follow(const Scene* scene, const RayCaster* rays,
                          std::shared_ptr<const Plan> plan, double camera_radius_m) {
    if (plan == seen_) return false;
    seen_ = std::move(plan);
    ++serial_;
    const bool is_measured =
        seen_ != nullptr && seen_->series.size() == seen_->trajectory.frames.size();
    if (seen_ == nullptr || is_measured) measured_ = seen_;
    if (seen_ == nullptr) quality_.reset();
    times_s_.clear();
    if (seen_ != nullptr) {
        for (const TrajectoryFrame& frame : seen_->trajectory.frames) {
            times_s_.push_back(frame.time_s);
        }
    }
    collisions_.clear();
    if (seen_ != nullptr && rays != nullptr) {
        collisions_ = planning::collidingFrames(*seen_, *rays, camera_radius_m);
    }
    keys_.clear();
    bands_.clear();
    if (seen_ != nullptr && scene != nullptr) {
        keys_ = ui::timelineKeys(*scene, *seen_);
        bands_ = ui::timelineBands(*seen_);
    }
    return true;
}

void PlanTimeline::followQuality(std::shared_ptr<const FrameQuality> quality, bool pending) {
    if (quality || !pending) quality_ = std::move(quality);
    quality_pending_ = pending;
}

}  // namespace dollytrack::editor
