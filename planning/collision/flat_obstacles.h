#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <span>

namespace dollytrack::planning {

/// The plan of what lies between two heights: surfaces cut off at them and seen from above, as a
/// scene of triangles with z = 0. The distance there from a point to the nearest surface is the
/// distance from an upright line between the two heights, to 0.1 mm.
class FlatObstacles {
  public:
    FlatObstacles(double bottom_m, double top_m) : bottom_(bottom_m), top_(top_m) {}

    /// The triangles of one object; false when none lies between the heights.
    bool addObject(const Scene& scene, const Object& object);

    /// The outline of a whole box, filled; false when it lies above or below.
    bool addBox(const OrientedBox& box);

    /// An object made of squares: those added between beginObject() and endObject(), which returns
    /// false when there were none.
    void beginObject();
    void addSquare(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
    bool endObject();

    /// Its objects are those for which true was returned, in their order.
    [[nodiscard]] const Scene& scene() const { return flat_; }

  private:
    void addPolygon(std::span<const Eigen::Vector2d> corners);

    double bottom_;
    double top_;
    Scene flat_;
};

}  // namespace dollytrack::planning
