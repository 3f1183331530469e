#include "planning/motions/repair_motion.h"

namespace dollytrack::planning {

Result<RepairedMotion> repairMotion(const BaselineScene& /*scene*/, const PlanParams& /*params*/,
                                    const Trajectory& given, const JobContext& job) {
    if (given.frames.empty()) {
        return fail(ErrorCode::BadInput, "The trajectory has no frames; nothing can be repaired.");
    }
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Repairing the motion was cancelled.");
    return RepairedMotion{given, {}};
}

}  // namespace dollytrack::planning
