#include "planning/motions/free_way.h"

#include "planning/collision/allowed_region.h"
#include "planning/collision/mapped_scene.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <unordered_map>

namespace dollytrack::planning {
namespace {

// Cost of a metre, in m2, in addition to the squared distance from the given motion.
constexpr double kLengthCost = 0.04;
// Farther than this from the given motion, m, all ways of one length cost the same.
constexpr double kFar = 1.0;
// Cost of ending a metre from the position asked for, as if that distance were walked.
constexpr double kEndCost = 1.0;
// A way may end near an end that is not exact. The search stops when this many nodes brought none
// nearer: an end far outside the rooms would otherwise lead through all of them.
constexpr std::size_t kMostWithoutGain = 30'000;
// Spacing of the points that distances from the given motion are measured to, m.
constexpr double kAlongSpacing = 0.1;
// Grids tried, in cells of the free-space map, with the number of nodes after which one gives up.
// In a narrow passage a legal position need not have room for the margin of SweptSphere::fits().
struct Grid {
    double cells;
    std::size_t most_nodes;
    bool with_margin;
};
constexpr std::array<Grid, 3> kGrids = {
    {{2.0, 600'000, true}, {1.0, 1'500'000, false}, {0.5, 1'500'000, false}}};

using Index = std::array<int, 3>;

struct Node {
    Eigen::Vector3d position;
    double cost = std::numeric_limits<double>::infinity();
    double sure_cost = std::numeric_limits<double>::infinity();  // by a move that is surely free
    int parent = -1;
    bool fits = false;
    bool closed = false;
    Index index{};
};

struct Entry {
    double bound = 0.0;  // of the cost of a whole way over the node
    double cost = 0.0;
    int node = 0;
    int parent = -1;
    bool operator>(const Entry& other) const {
        return std::tie(bound, node, parent) > std::tie(other.bound, other.node, other.parent);
    }
};

class WaySearch {
  public:
    WaySearch(const MappedScene& scene, const Eigen::Vector3d& from, const WayEnd& end,
              std::vector<Eigen::Vector3d> along, const Grid& grid)
        : scene_(scene),
          from_(from),
          end_(end),
          along_(std::move(along)),
          step_(grid.cells * scene.free_space->resolution_m()),
          with_margin_(grid.with_margin),
          flat_(scene.region->restricts() && scene.region->hasLevels()) {
        nodes_.emplace_back();
        nodes_.back().position = from;
        nodes_.back().fits = true;
        by_index_.emplace(keyOf({0, 0, 0}), 0);
    }

    /// Moves between nodes are proven only when they are taken from the queue: most never are.
    std::optional<std::vector<Eigen::Vector3d>> run(std::size_t most_nodes, const JobContext& job) {
        queue_.push({restCost(from_), 0.0, 0, -1});
        while (!queue_.empty() && nodes_.size() < most_nodes) {
            const Entry entry = queue_.top();
            queue_.pop();
            if (entry.bound >= best_cost_) break;
            if (nodes_[entry.node].closed || !isMoveFree(entry)) continue;
            Node& node = nodes_[entry.node];
            node.closed = true;
            node.cost = entry.cost;
            node.parent = entry.parent;
            tryEnd(entry.node);
            expand(entry.node);
            if (++popped_ % 1024 == 0 && job.cancelled()) return std::nullopt;
            if (!end_.exact && popped_ > best_at_ + kMostWithoutGain) break;
        }
        if (best_end_ < 0) return std::nullopt;
        std::vector<Eigen::Vector3d> way;
        if (end_.exact) way.push_back(end_.position);
        for (int i = best_end_; i >= 0; i = nodes_[i].parent) way.push_back(nodes_[i].position);
        std::reverse(way.begin(), way.end());
        return way;
    }

  private:
    static std::uint64_t keyOf(const Index& index) {
        constexpr int kHalf = 1 << 20;
        std::uint64_t key = 0;
        for (const int i : index) key = (key << 21) | static_cast<std::uint64_t>(i + kHalf);
        return key;
    }

    [[nodiscard]] double restCost(const Eigen::Vector3d& position) const {
        return end_.exact ? kLengthCost * (end_.position - position).norm() : 0.0;
    }

    [[nodiscard]] double costPerMetre(const Eigen::Vector3d& position) const {
        double squared = kFar * kFar;
        for (const Eigen::Vector3d& point : along_) {
            squared = std::min(squared, (point - position).squaredNorm());
        }
        return kLengthCost + squared;
    }

    [[nodiscard]] bool isMoveFree(const Entry& entry) const {
        return entry.parent < 0 ||
               scene_.sphere->segment(nodes_[entry.parent].position, nodes_[entry.node].position)
                   .free;
    }

    void tryEnd(int node) {
        const Eigen::Vector3d& position = nodes_[node].position;
        const double distance = (end_.position - position).norm();
        double cost = nodes_[node].cost;
        if (end_.exact) {
            if (distance > 2.0 * step_) return;
            cost += distance * costPerMetre(end_.position);
        } else {
            cost += kEndCost * distance * distance;
        }
        if (cost >= best_cost_) return;
        if (end_.exact && !scene_.sphere->segment(position, end_.position).free) return;
        best_cost_ = cost;
        best_end_ = node;
        best_at_ = popped_;
    }

    void expand(int from) {
        // Moves within the clearance are free, so that dearer ones to the same node need no test.
        const double clearance =
            scene_.region->restricts()
                ? 0.0
                : scene_.free_space->clearanceLowerBound(nodes_[from].position);
        const double free_m = clearance - scene_.sphere->radius() - SweptSphere::kMargin;
        for (int i = 0; i < 27; ++i) {
            const Index step = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
            if (flat_ && step[2] != 0) continue;
            const int to = nodeAt(nodes_[from].index, step);
            if (!nodes_[to].fits || nodes_[to].closed) continue;
            const Eigen::Vector3d& position = nodes_[to].position;
            const double length = (position - nodes_[from].position).norm();
            const double cost = nodes_[from].cost + length * costs_[to];
            if (cost >= nodes_[to].sure_cost) continue;
            if (length < free_m) nodes_[to].sure_cost = cost;
            queue_.push({cost + restCost(position), cost, to, from});
        }
    }

    int nodeAt(const Index& from, const Index& step) {
        const Index index = {from[0] + step[0], from[1] + step[1], from[2] + step[2]};
        const auto [found, is_new] =
            by_index_.try_emplace(keyOf(index), static_cast<int>(nodes_.size()));
        if (!is_new) return found->second;
        Node node;
        node.position = from_ + step_ * Eigen::Vector3d(index[0], index[1], index[2]);
        node.fits = with_margin_ ? scene_.sphere->fits(node.position)
                                 : scene_.sphere->segment(node.position, node.position).free;
        node.index = index;
        nodes_.push_back(node);
        costs_.resize(nodes_.size());
        costs_.back() = node.fits ? costPerMetre(node.position) : 0.0;
        return found->second;
    }

    const MappedScene& scene_;
    Eigen::Vector3d from_;
    WayEnd end_;
    std::vector<Eigen::Vector3d> along_;
    double step_;
    bool with_margin_;
    bool flat_;  // the camera stays at one height
    std::vector<Node> nodes_;
    std::vector<double> costs_;  // by node: of a metre there
    std::unordered_map<std::uint64_t, int> by_index_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    double best_cost_ = std::numeric_limits<double>::infinity();
    int best_end_ = -1;
    std::size_t popped_ = 0;
    std::size_t best_at_ = 0;  // value of popped_ when best_end_ was found
};

std::vector<Eigen::Vector3d> thinned(const std::vector<Eigen::Vector3d>& points) {
    std::vector<Eigen::Vector3d> kept;
    for (const Eigen::Vector3d& point : points) {
        if (kept.empty() || (point - kept.back()).norm() >= kAlongSpacing) kept.push_back(point);
    }
    return kept;
}

}  // namespace

std::optional<std::vector<Eigen::Vector3d>> findFreeWay(const MappedScene& scene,
                                                        const Eigen::Vector3d& from,
                                                        const WayEnd& end,
                                                        const std::vector<Eigen::Vector3d>& along,
                                                        const JobContext& job) {
    for (const Grid& grid : kGrids) {
        WaySearch search(scene, from, end, thinned(along), grid);
        if (auto way = search.run(grid.most_nodes, job)) return way;
        if (job.cancelled()) break;
    }
    return std::nullopt;
}

}  // namespace dollytrack::planning
