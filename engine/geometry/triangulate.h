#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {

/// How a polygon was triangulated.
enum class PolygonOutcome {
    Exact,        // constrained Delaunay: covers the polygon and nothing else
    Approximate,  // crosses itself: a fan, as most viewers draw it
    Degenerate,   // no area: no triangles
};

/// Appends the triangles of a polygon of three or more corners, as indices into `corners`, in the
/// polygon's winding. Handles concave outlines, collinear or repeated corners, slightly non-planar
/// faces, and holes that are joined to the outline by a doubled edge.
PolygonOutcome triangulatePolygon(std::span<const Eigen::Vector3f> corners,
                                  std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace dollytrack
