#include "planning/collision/no_go_index.h"

#include <algorithm>
#include <numeric>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kLeafBoxes = 4;
// Distances to bounds and to the boxes inside them round differently.
constexpr double kRounding_m = 1e-6;

}  // namespace

NoGoIndex::NoGoIndex(const std::vector<NoGoBox>& boxes) : order_(boxes.size()) {
    for (const NoGoBox& one : boxes) {
        boxes_.push_back(one.box);
        Eigen::AlignedBox3d& bounds = bounds_.emplace_back();
        for (const Eigen::Vector3d& corner : one.box.corners()) bounds.extend(corner);
    }
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    if (!boxes.empty()) build(0, boxes.size());
}

void NoGoIndex::build(std::size_t begin, std::size_t end) {
    const std::size_t node = nodes_.size();
    nodes_.emplace_back();
    Eigen::AlignedBox3d bounds;
    Eigen::AlignedBox3d centers;
    for (std::size_t i = begin; i < end; ++i) {
        bounds.extend(bounds_[order_[i]]);
        centers.extend(bounds_[order_[i]].center());
    }
    nodes_[node] = {bounds, begin, end, 0};
    if (end - begin <= kLeafBoxes) return;
    Eigen::Index axis = 0;
    centers.sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
        return bounds_[a].center()[axis] < bounds_[b].center()[axis];
    });
    build(begin, middle);
    nodes_[node].right = nodes_.size();
    build(middle, end);
}

NoGoIndex::Nearest NoGoIndex::nearest(const Eigen::Vector3d& point, double limit_m) const {
    Nearest best{kNone, limit_m};
    if (!nodes_.empty()) look(0, point, best);
    if (best.box == kNone) return {};
    return best;
}

void NoGoIndex::look(std::size_t node, const Eigen::Vector3d& point, Nearest& best) const {
    const Node& here = nodes_[node];
    if (here.bounds.exteriorDistance(point) > best.distance_m + kRounding_m) return;
    if (here.right == 0) {
        for (std::size_t i = here.begin; i < here.end; ++i) {
            const std::size_t box = order_[i];
            const double distance = boxes_[box].distance(point);
            const bool nearer = distance < best.distance_m;
            const bool first = distance == best.distance_m && best.box != kNone && box < best.box;
            if (nearer || first) best = {box, distance};
        }
        return;
    }
    std::size_t first = node + 1;
    std::size_t second = here.right;
    if (nodes_[second].bounds.squaredExteriorDistance(point) <
        nodes_[first].bounds.squaredExteriorDistance(point)) {
        std::swap(first, second);
    }
    look(first, point, best);
    look(second, point, best);
}

}  // namespace dollytrack::planning
