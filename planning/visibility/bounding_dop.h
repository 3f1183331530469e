#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <array>

namespace dollytrack::planning {

/// Bounding 26-DOP (discrete oriented polytope) of an object: 13 slabs whose normals point to the
/// 26 neighbours of a cube, in axes rotated with the object's box. Culls rays that miss the object.
class BoundingDop {
  public:
    static constexpr int kSlabs = 13;
    using Slabs = Eigen::Array<float, kSlabs + 3, 1>;  // padded to whole SIMD registers

    BoundingDop() = default;
    BoundingDop(const Scene& scene, const Object& object);

    /// The polytope relative to one ray origin, for many directions.
    class FromOrigin {
      public:
        FromOrigin(const BoundingDop& bounds, const Eigen::Vector3d& origin);

        /// Number of directions per call, as SIMD lanes: x, y and z of each.
        static constexpr int kAtOnce = 4;
        using Directions = std::array<Eigen::Array<float, kAtOnce, 1>, 3>;

        /// For each direction, the t at which origin + t * direction leaves the polytope, rounded
        /// up slightly; negative if the ray misses the polytope or it lies behind the origin.
        [[nodiscard]] Eigen::Array<float, kAtOnce, 1> exits(const Directions& directions) const;

      private:
        const BoundingDop* bounds_;
        Slabs to_low_, to_high_;  // along each normal, from the origin
    };

  private:
    std::array<Slabs, 3> normals_ = {Slabs::Zero(), Slabs::Zero(), Slabs::Zero()};  // by coordinate
    Slabs low_ = Slabs::Constant(-1.0F);
    Slabs high_ = Slabs::Constant(1.0F);
};

}  // namespace dollytrack::planning
