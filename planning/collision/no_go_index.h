#pragma once

#include "engine/document/edits.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <vector>

namespace dollytrack::planning {

/// Bounding volume hierarchy over no-go boxes. Results equal those of a test of every box.
/// Immutable.
class NoGoIndex {
  public:
    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

    struct Nearest {
        std::size_t box = kNone;  // index; the lowest of several at the same distance
        double distance_m = std::numeric_limits<double>::infinity();
    };

    explicit NoGoIndex(const std::vector<NoGoBox>& boxes);

    /// The nearest box closer than `limit_m`; kNone and infinity if there is none.
    [[nodiscard]] Nearest nearest(const Eigen::Vector3d& point, double limit_m) const;

  private:
    struct Node {
        Eigen::AlignedBox3d bounds;
        std::size_t begin = 0;  // range in order_
        std::size_t end = 0;
        std::size_t right = 0;  // index of the second child (the first is the next node); 0: leaf
    };

    void build(std::size_t begin, std::size_t end);
    void look(std::size_t node, const Eigen::Vector3d& point, Nearest& best) const;

    std::vector<OrientedBox> boxes_;
    std::vector<Eigen::AlignedBox3d> bounds_;  // by box
    std::vector<std::size_t> order_;           // box indices, sorted by leaf
    std::vector<Node> nodes_;
};

}  // namespace dollytrack::planning
