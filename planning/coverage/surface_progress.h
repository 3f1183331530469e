#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace dollytrack::planning {

/// Directions from which a patch was seen, any two of them at least 15 degrees apart. A direction
/// nearer than that to one counted before does not count, so the number depends on the order.
class DistinctDirections {
  public:
    static constexpr int kMost = 8;
    static constexpr double kApartCosine = 0.96592582628906831;  // of 15 degrees

    /// Whether a unit direction would count, if up to `wanted` do.
    [[nodiscard]] bool adds(const Eigen::Vector3d& direction, int wanted) const;
    void add(const Eigen::Vector3d& direction, int wanted) {
        if (adds(direction, wanted)) directions_[count_++] = direction;
    }
    [[nodiscard]] int count() const { return count_; }

  private:
    std::array<Eigen::Vector3d, kMost> directions_;
    int count_ = 0;
};

/// A patch that a view shows.
struct PatchObservation {
    std::size_t patch = 0;
    bool sharp = false;  // near enough for the resolution asked for
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit, from the patch to the camera
};

/// What the views so far show of each patch, and the gain of another one. Gains never grow as
/// views are added.
class SurfaceProgress {
  public:
    /// `wanted`: directions per patch from which it can be seen sharply, and shall be.
    explicit SurfaceProgress(std::vector<int> wanted);

    /// Gain of an observation: 1 for a patch not seen before, and 1 / n for its nth direction.
    [[nodiscard]] double gain(const PatchObservation& observation) const;
    void add(const PatchObservation& observation);

    /// Whether at least this share of the patches is seen, and of the wanted directions covered.
    [[nodiscard]] bool reaches(double share) const;

  private:
    std::vector<int> wanted_;
    std::vector<char> seen_;
    std::vector<DistinctDirections> sharp_;
    std::size_t all_directions_ = 0;
    std::size_t covered_directions_ = 0;
    std::size_t seen_patches_ = 0;
};

}  // namespace dollytrack::planning
