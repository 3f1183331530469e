#pragma once

#include "engine/io/import/raw_scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace dollytrack::semantics {

/// The corners of a triangle.
using Corners = std::array<Eigen::Vector3d, 3>;

[[nodiscard]] Corners cornersOf(const MeshPart& part, const Triangle& triangle,
                                const Eigen::Affine3d& turn = Eigen::Affine3d::Identity());

[[nodiscard]] Eigen::Vector3d middleOf(const Corners& corners);

/// The triangles of a labelled scene in a tree of boxes, to find the object of another mesh's
/// triangle. All questions may be asked from many threads.
class LabelledSurface {
  public:
    explicit LabelledSurface(const RawScene& labelled);

    /// The object of the same triangle, else of the nearest one within `radius`, as its number from
    /// 1 on; 0: none is near. Of objects that are equally near, the one with the lowest number.
    [[nodiscard]] int objectAt(const Corners& corners, double radius) const;

    /// How far away the nearest triangle is; `radius` where there is none within it.
    [[nodiscard]] double distance(const Eigen::Vector3d& point, double radius) const;

  private:
    struct Labelled {
        std::array<Eigen::Vector3f, 3> corners;
        int object;
    };
    struct Node {
        Eigen::AlignedBox3f box;
        std::size_t begin;  // of the triangles in it
        std::size_t end;
        std::size_t second;  // child; the first one comes next. 0: a leaf
    };
    /// A triangle's corners to a thousandth of a unit, in an order of their own.
    using Key = std::array<std::array<std::int64_t, 3>, 3>;

    static Key keyOf(const Corners& corners);
    void build(std::size_t begin, std::size_t end);
    template <class Visit>
    void visitNear(const Eigen::Vector3d& point, const double& reach, Visit&& visit) const;

    std::vector<Labelled> triangles_;
    std::vector<Node> nodes_;
    std::map<Key, int> same_;
};

}  // namespace dollytrack::semantics
