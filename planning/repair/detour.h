#pragma once

#include "planning/repair/repair_context.h"

#include <optional>

namespace dollytrack::planning {

/// Searches a detour between two key frames of a path, the vertices `from` and `to`: plans up to
/// four paths by RRT*, makes a trajectory of each, and returns the part of the path with the
/// smallest share of low frames. Empty if no share is below `low_share`, or all detours are longer
/// than 1.5 times the present part plus 0.5 m.
[[nodiscard]] std::optional<CameraPath> findDetour(const RepairContext& context,
                                                   const CameraPath& path, std::size_t from,
                                                   std::size_t to, double low_share,
                                                   std::uint64_t stream);

}  // namespace dollytrack::planning
