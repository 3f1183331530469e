#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <array>

namespace dollytrack::planning {

/// A tight convex cover of an object: 13 slabs, whose normals point to the 26 neighbours of a
/// cube's cell, in axes turned with the object's box. Spares tracing rays that pass the object by.
class SlabHull {
  public:
    static constexpr int kSlabs = 13;
    using Slabs = Eigen::Array<float, kSlabs + 3, 1>;  // padded to whole registers

    SlabHull() = default;
    SlabHull(const Scene& scene, const Object& object);

    /// The hull as seen from one point, for asking about many directions.
    class From {
      public:
        From(const SlabHull& hull, const Eigen::Vector3d& origin);

        /// As many directions as are asked about at once: x, y and z of each.
        static constexpr int kAtOnce = 4;
        using Directions = std::array<Eigen::Array<float, kAtOnce, 1>, 3>;

        /// For each, the t at which origin + t * direction leaves the hull, a hair late; negative
        /// when the ray misses the hull or the hull lies behind it.
        [[nodiscard]] Eigen::Array<float, kAtOnce, 1> exits(const Directions& directions) const;

      private:
        const SlabHull* hull_;
        Slabs to_low_, to_high_;  // along each normal, from the origin
    };

  private:
    std::array<Slabs, 3> normals_ = {Slabs::Zero(), Slabs::Zero(), Slabs::Zero()};  // by coordinate
    Slabs low_ = Slabs::Constant(-1.0F);
    Slabs high_ = Slabs::Constant(1.0F);
};

}  // namespace dollytrack::planning
