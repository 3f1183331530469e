#pragma once

#include "planning/repair/repair_context.h"

#include <optional>

namespace dollytrack::planning {

/// Another way between two key frames of a path, which scores better than the one it takes.
/// `from` and `to` are indices of their vertices. Tries a few ways by RRT*, makes a trajectory of
/// each and takes the one with the smallest share of low frames. Nothing when none has a smaller
/// share than `low_share`, or all are much longer.
[[nodiscard]] std::optional<CameraPath> findOtherWay(const RepairContext& context,
                                                     const CameraPath& path, std::size_t from,
                                                     std::size_t to, double low_share,
                                                     std::uint64_t stream);

}  // namespace dollytrack::planning
