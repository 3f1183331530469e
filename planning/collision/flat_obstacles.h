#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <span>

namespace dollytrack::planning {

/// Top view of all surfaces between two heights: triangles are clipped to that slab and projected
/// to z = 0. The distance from a point to the nearest projected triangle equals the horizontal
/// distance from the vertical line segment spanning the slab to the nearest surface, within 0.1 mm.
/// Polygons thinner than that are stored as line segments (degenerate triangles).
class FlatObstacles {
  public:
    FlatObstacles(double bottom_m, double top_m) : bottom_(bottom_m), top_(top_m) {}

    /// Adds the triangles of one object. Returns false if none lies in the slab.
    bool addObject(const Scene& scene, const Object& object);

    /// Adds the footprint of a box, filled. Returns false if the box is above or below the slab.
    bool addBox(const OrientedBox& box);

    /// Adds an object made of axis-aligned rectangles: those added between beginObject() and
    /// endObject(), which returns false if there were none.
    void beginObject();
    void addSquare(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
    bool endObject();

    /// The projected scene. It holds one object per call that returned true, in that order.
    [[nodiscard]] const Scene& scene() const { return flat_; }

  private:
    void addPolygon(std::span<const Eigen::Vector2d> corners);

    double bottom_;
    double top_;
    Scene flat_;
};

}  // namespace dollytrack::planning
