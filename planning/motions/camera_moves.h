#pragma once

#include "planning/motions/repair_motion.h"

#include <map>
#include <optional>
#include <string>

namespace dollytrack::planning {

/// A camera move made from a template, for example "orbit:target=sofa,radius=1.5".
struct MoveRequest {
    std::string kind;
    std::map<std::string, std::string> options;
    std::optional<int> object_id = {};  // object that the move is about, instead of `target`
};

/// Reads a request. Errors: Usage for an unknown kind or option, with the closest name.
Result<MoveRequest> parseMove(const std::string& text);

/// Makes the move, free of collisions and within the motion limits: the ideal move where it is
/// free, repaired elsewhere (see repairMotion()). Errors: Usage for a value that cannot be read;
/// BadInput if the object is unknown or there is no free space for the move; Cancelled.
Result<RepairedMotion> makeMove(const BaselineScene& scene, const PlanParams& params,
                                const MoveRequest& request, const JobContext& job);

/// Kinds of moves and their options, a line each.
std::string moveHelp();

}  // namespace dollytrack::planning
