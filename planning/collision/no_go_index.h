#pragma once

#include "engine/document/edits.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <vector>

namespace dollytrack::planning {

/// A bounding volume hierarchy over no-go boxes: distances as if every box were asked, in a time
/// that hardly grows with their number. Const.
class NoGoIndex {
  public:
    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

    struct Nearest {
        std::size_t box = kNone;  // index; the first of several that are as near
        double distance_m = std::numeric_limits<double>::infinity();
    };

    explicit NoGoIndex(const std::vector<NoGoBox>& boxes);

    /// The nearest box that is nearer than `limit_m`.
    [[nodiscard]] Nearest nearest(const Eigen::Vector3d& point, double limit_m) const;

  private:
    struct Node {
        Eigen::AlignedBox3d bounds;
        std::size_t begin = 0;  // of order_
        std::size_t end = 0;
        std::size_t right = 0;  // index of the second child, the first follows its parent; 0: leaf
    };

    void build(std::size_t begin, std::size_t end);
    void look(std::size_t node, const Eigen::Vector3d& point, Nearest& best) const;

    std::vector<OrientedBox> boxes_;
    std::vector<Eigen::AlignedBox3d> bounds_;  // of each box
    std::vector<std::size_t> order_;           // indices of boxes, leaf by leaf
    std::vector<Node> nodes_;
};

}  // namespace dollytrack::planning
