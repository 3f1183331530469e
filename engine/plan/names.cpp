#include "engine/plan/capture_ledger.h"
#include "engine/plan/targets.h"
#include "engine/plan/viewpoint.h"

namespace dollytrack {

std::string_view name(TargetKind kind) {
    switch (kind) {
        case TargetKind::Single:
            return "single";
        case TargetKind::Support:
            return "support";
        case TargetKind::Suspension:
            return "suspension";
        case TargetKind::Shelf:
            return "shelf";
    }
    return {};
}

std::string_view name(Verdict verdict) {
    switch (verdict) {
        case Verdict::Legal:
            return "legal";
        case Verdict::InObstacle:
            return "in_obstacle";
        case Verdict::OutsideRoom:
            return "outside_room";
        case Verdict::OccludedBy:
            return "occluded_by";
        case Verdict::TooClose:
            return "too_close";
        case Verdict::Cropped:
            return "cropped";
        case Verdict::TooSmall:
            return "too_small";
        case Verdict::NoGo:
            return "no_go";
        case Verdict::HeightBand:
            return "height_band";
        case Verdict::PitchBand:
            return "pitch_band";
        case Verdict::InGap:
            return "in_gap";
        case Verdict::Unscanned:
            return "unscanned";
    }
    return {};
}

std::string_view name(Loss loss) {
    switch (loss) {
        case Loss::NoFreePose:
            return "no_free_pose";
        case Loss::Occluded:
            return "occluded";
        case Loss::TooSmall:
            return "too_small";
        case Loss::DoesNotFit:
            return "does_not_fit";
        case Loss::PitchBand:
            return "pitch_band";
        case Loss::OtherComponent:
            return "other_component";
        case Loss::DroppedByPath:
            return "dropped_by_path";
        case Loss::LostInSmoothing:
            return "lost_in_smoothing";
        case Loss::DroppedByScore:
            return "dropped_by_score";
        case Loss::ByHand:
            return "by_hand";
        case Loss::SearchMissed:
            return "search_missed";
        case Loss::NotInMotion:
            return "not_in_motion";
        case Loss::OverBudget:
            return "over_budget";
    }
    return {};
}

}  // namespace dollytrack
