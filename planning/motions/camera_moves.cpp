#include "planning/motions/camera_moves.h"

namespace dollytrack::planning {

Result<MoveRequest> parseMove(const std::string& text) {
    return fail(ErrorCode::Usage, "The kind of move is unknown.", text);
}

Result<RepairedMotion> makeMove(const BaselineScene& /*scene*/, const PlanParams& /*params*/,
                                const MoveRequest& request, const JobContext& /*job*/) {
    return fail(ErrorCode::Usage, "The kind of move is unknown.", request.kind);
}

std::string moveHelp() {
    return {};
}

}  // namespace dollytrack::planning
