#pragma once

namespace dollytrack::planning {

/// Rays per side for ViewEstimator::estimate() in the coarse pass over many candidates; promising
/// ones are then sampled exactly.
inline constexpr int kCoarseGrid = 14;

}  // namespace dollytrack::planning
