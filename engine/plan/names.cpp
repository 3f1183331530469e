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
    }
    return {};
}

}  // namespace dollytrack
