#pragma once

#include "engine/io/raw_scene/raw_scene.h"

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

/// A bounding volume hierarchy of a labelled scene's triangles, to find the objects of another
/// mesh's triangles. Const calls are thread-safe.
class LabelledSurface {
  public:
    explicit LabelledSurface(const RawScene& labelled);

    /// The object of an equal triangle, otherwise of the triangle nearest to the centre within
    /// `radius`: its index in RawScene::objects plus 1; 0 if none is near. Of equally near objects
    /// (within 1e-4 of `radius`) the lowest number.
    [[nodiscard]] int objectAt(const Corners& corners, double radius) const;

    /// Distance from a point to the nearest triangle, at most `radius`.
    [[nodiscard]] double distance(const Eigen::Vector3d& point, double radius) const;

  private:
    struct Labelled {
        std::array<Eigen::Vector3f, 3> corners;
        int object;
    };
    struct Node {
        Eigen::AlignedBox3f box;
        std::size_t begin;  // range of its triangles
        std::size_t end;
        std::size_t second;  // index of the second child; the first is the next node. 0: a leaf
        int lowest;          // lowest object number in it
    };
    /// A triangle's corners, sorted and in units of a millionth of the scene's diagonal.
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
