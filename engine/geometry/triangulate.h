#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {

/// How a polygon became triangles.
enum class PolygonOutcome {
    Exact,        // constrained Delaunay: covers the polygon and nothing else
    Approximate,  // crosses itself: a fan, as most viewers draw it
    Degenerate,   // no area: no triangles
};

/// Appends the triangles of one polygon of three or more corners, as indices into `corners`, with
/// the polygon's own winding. Concave outlines, collinear or repeated corners, holes joined to the
/// outline by a doubled edge and slightly bent faces are all taken as drawn.
PolygonOutcome triangulatePolygon(std::span<const Eigen::Vector3f> corners,
                                  std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace dollytrack
