#pragma once

namespace dollytrack::planning {

/// The grid for ViewEstimator::estimate() that tells, of many places, which are worth an exact
/// look.
inline constexpr int kCoarseGrid = 14;

}  // namespace dollytrack::planning
