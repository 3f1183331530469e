#include "planning/coverage/surface_progress.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dollytrack::planning {

bool DistinctDirections::adds(const Eigen::Vector3d& direction, int wanted) const {
    if (count_ >= std::min(wanted, kMost)) return false;
    return std::none_of(
        directions_.begin(), directions_.begin() + count_,
        [&](const Eigen::Vector3d& other) { return other.dot(direction) > kApartCosine; });
}

SurfaceProgress::SurfaceProgress(std::vector<int> wanted)
    : wanted_(std::move(wanted)),
      seen_(wanted_.size(), 0),
      sharp_(wanted_.size()),
      all_directions_(std::accumulate(wanted_.begin(), wanted_.end(), std::size_t{0})) {}

double SurfaceProgress::gain(const PatchObservation& observation) const {
    const std::size_t p = observation.patch;
    double gain = seen_[p] == 0 ? 1.0 : 0.0;
    if (observation.sharp && sharp_[p].adds(observation.direction, wanted_[p])) {
        gain += 1.0 / (sharp_[p].count() + 1);
    }
    return gain;
}

void SurfaceProgress::add(const PatchObservation& observation) {
    const std::size_t p = observation.patch;
    seen_patches_ += seen_[p] == 0 ? 1 : 0;
    seen_[p] = 1;
    if (!observation.sharp) return;
    const int before = sharp_[p].count();
    sharp_[p].add(observation.direction, wanted_[p]);
    covered_directions_ += static_cast<std::size_t>(sharp_[p].count() - before);
}

bool SurfaceProgress::reaches(double share) const {
    return static_cast<double>(seen_patches_) >= share * static_cast<double>(seen_.size()) &&
           static_cast<double>(covered_directions_) >= share * static_cast<double>(all_directions_);
}

}  // namespace dollytrack::planning
