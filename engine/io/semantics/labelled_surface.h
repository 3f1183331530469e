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
                                const Eigen::Affine3d& rotation = Eigen::Affine3d::Identity());

[[nodiscard]] Eigen::Vector3d middleOf(const Corners& corners);

/// The triangles of a labelled scene, each once, in a tree of boxes, to find the object of another
/// mesh's triangle. Const calls are thread-safe.
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
        int lowest;          // number of the objects in it
    };
    /// A triangle's corners in millionths of the scene's diagonal, in an order of their own.
    using Key = std::array<std::array<std::int64_t, 3>, 3>;

    [[nodiscard]] Key keyOf(const Corners& corners) const;
    void build(std::size_t begin, std::size_t end);
    template <class Skip, class Visit>
    void visitNear(const Eigen::Vector3d& point, Skip&& skip, Visit&& visit) const;

    Eigen::AlignedBox3d box_;
    double key_step_ = 1.0;
    std::vector<Labelled> triangles_;
    std::vector<Node> nodes_;
    std::map<Key, int> same_;
};

}  // namespace dollytrack::semantics
