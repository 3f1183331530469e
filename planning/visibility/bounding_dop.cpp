#include "planning/visibility/bounding_dop.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::planning {
namespace {

// One of each pair of opposite directions to the neighbours of a cube.
constexpr std::array<std::array<int, 3>, BoundingDop::kSlabs> kNormals = {{{1, 0, 0},
                                                                           {0, 1, 0},
                                                                           {0, 0, 1},
                                                                           {1, 1, 0},
                                                                           {1, -1, 0},
                                                                           {1, 0, 1},
                                                                           {1, 0, -1},
                                                                           {0, 1, 1},
                                                                           {0, 1, -1},
                                                                           {1, 1, 1},
                                                                           {1, 1, -1},
                                                                           {1, -1, 1},
                                                                           {-1, 1, 1}}};
// Relative enlargement, so that float rounding never lets a ray miss a surface it grazes.
constexpr float kSlack = 1e-4F;
// Avoids a division by zero for rays parallel to a slab.
constexpr float kParallel = 1e-20F;

}  // namespace

BoundingDop::BoundingDop(const Scene& scene, const Object& object) {
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(static_cast<float>(object.box.yaw), Eigen::Vector3f::UnitZ())
            .toRotationMatrix();
    for (int k = 0; k < kSlabs; ++k) {
        const auto& n = kNormals[k];
        const Eigen::Vector3f normal = turn * Eigen::Vector3f(n[0], n[1], n[2]).normalized();
        for (int axis = 0; axis < 3; ++axis) {
            normals_[axis][k] = normal[axis];
        }
    }
    low_.head<kSlabs>().setConstant(std::numeric_limits<float>::infinity());
    high_.head<kSlabs>().setConstant(-std::numeric_limits<float>::infinity());
    float furthest = 0.0F;
    for (std::uint32_t v = object.first_vertex; v < object.first_vertex + object.vertex_count;
         ++v) {
        const Eigen::Vector3f& p = scene.positions[v];
        const Slabs along = p.x() * normals_[0] + p.y() * normals_[1] + p.z() * normals_[2];
        low_.head<kSlabs>() = low_.head<kSlabs>().min(along.head<kSlabs>());
        high_.head<kSlabs>() = high_.head<kSlabs>().max(along.head<kSlabs>());
        furthest = std::max(furthest, p.cwiseAbs().maxCoeff());
    }
    const float slack = kSlack * (1.0F + furthest);
    low_ -= slack;
    high_ += slack;
}

BoundingDop::FromOrigin::FromOrigin(const BoundingDop& bounds, const Eigen::Vector3d& origin)
    : bounds_(&bounds) {
    const Eigen::Vector3f p = origin.cast<float>();
    const Slabs along =
        p.x() * bounds.normals_[0] + p.y() * bounds.normals_[1] + p.z() * bounds.normals_[2];
    to_low_ = bounds.low_ - along;
    to_high_ = bounds.high_ - along;
}

Eigen::Array<float, BoundingDop::FromOrigin::kAtOnce, 1> BoundingDop::FromOrigin::exits(
    const Directions& directions) const {
    using Lanes = Eigen::Array<float, kAtOnce, 1>;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Lanes enter = Lanes::Constant(-kInfinity);
    Lanes leave = Lanes::Constant(kInfinity);
    // One slab at a time for all rays: no horizontal operations across a SIMD register.
    for (int k = 0; k < kSlabs; ++k) {
        const Lanes speed = directions[0] * bounds_->normals_[0][k] +
                            directions[1] * bounds_->normals_[1][k] +
                            directions[2] * bounds_->normals_[2][k] + kParallel;
        const Lanes inverse = speed.inverse();
        const Lanes a = to_low_[k] * inverse;
        const Lanes b = to_high_[k] * inverse;
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    return (enter <= leave).select(leave * (1.0F + kSlack), -1.0F);
}

}  // namespace dollytrack::planning
