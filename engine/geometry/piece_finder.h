#pragma once

#include "engine/core/disjoint_sets.h"
#include "engine/geometry/vertex_join.h"

#include <Eigen/Core>

#include <cmath>
#include <cstdint>

namespace dollytrack {

/// Finds the connected pieces of a mesh. Vertices within 0.1 mm are welded into one place, and the
/// three places of a triangle are joined.
class PieceFinder {
  public:
    explicit PieceFinder(std::size_t expected) : places_(expected) {}

    /// Adds a vertex and returns the number of its place; places are numbered as they appear.
    std::uint32_t add(const Eigen::Vector3f& p) {
        // Rounding to a grid separates a few equal points. Shifted grids are not worth their cost:
        // exporters repeat shared vertices exactly.
        const auto grid = [](float x) { return std::round(x / kWeld_m); };
        const std::uint32_t place = places_.insert({grid(p.x()), grid(p.y()), grid(p.z())});
        if (place == pieces_.size()) pieces_.add();
        return place;
    }

    /// The smallest place in the piece that this place belongs to.
    std::uint32_t find(std::uint32_t place) { return pieces_.find(place); }

    void join(std::uint32_t a, std::uint32_t b) { pieces_.join(a, b); }

  private:
    static constexpr float kWeld_m = 1e-4F;
    VertexJoin<3> places_;
    DisjointSets<std::uint32_t> pieces_;
};

}  // namespace dollytrack
