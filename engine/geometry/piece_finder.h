#pragma once

#include "engine/geometry/vertex_join.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace dollytrack {

/// Finds out which surfaces hang together: corners at the same place, to 0.1 mm, are one, and
/// triangles join their corners.
class PieceFinder {
  public:
    explicit PieceFinder(std::size_t expected) : places_(expected) {}

    /// The number of the place a corner is at.
    std::uint32_t add(const Eigen::Vector3f& p) {
        // Rounding to a grid parts a few equal points; half-cell shifts are not worth it, as
        // exporters repeat shared corners exactly.
        const auto grid = [](float x) { return std::round(x / kWeld_m); };
        const std::uint32_t place = places_.insert({grid(p.x()), grid(p.y()), grid(p.z())});
        if (place == root_.size()) root_.push_back(place);
        return place;
    }

    /// The lowest place of the piece that a place belongs to.
    std::uint32_t find(std::uint32_t i) {
        while (root_[i] != i) i = root_[i] = root_[root_[i]];
        return i;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t low = std::min(find(a), find(b));
        const std::uint32_t high = std::max(find(a), find(b));
        root_[high] = low;
    }

  private:
    static constexpr float kWeld_m = 1e-4F;
    VertexJoin<3> places_;
    std::vector<std::uint32_t> root_;
};

}  // namespace dollytrack
