#include "planning/linking/rrt_star.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr double kReach = 1.5;     // longest single move, m
constexpr int kSmallTree = 64;     // in nodes
constexpr double kShorter = 0.15;  // factor of a blocked move
constexpr double kRewire = 2.0;    // factor of the shrinking rewiring radius, m

struct Node {
    Eigen::Vector3d position;
    int parent = -1;
    double cost = 0.0;
    int first_parent = -1;  // before rewiring
};

class Tree {
  public:
    Tree(const RrtStarProblem& problem) : problem_(problem) {
        nodes_.push_back({problem.start, -1, 0.0, -1});
    }

    [[nodiscard]] int nearest(const Eigen::Vector3d& point) const {
        int best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const double squared = (nodes_[i].position - point).squaredNorm();
            if (squared >= least) continue;
            least = squared;
            best = static_cast<int>(i);
        }
        return best;
    }

    /// Adds the point with its cheapest free parent, then rewires its neighbours through it.
    /// Returns false if no move to it is free.
    bool add(const Eigen::Vector3d& point) {
        const double n = static_cast<double>(nodes_.size()) + 1.0;
        const double radius = std::min(kReach, kRewire * std::cbrt(std::log(n) / n));
        const std::vector<int> near = cheapestFirst(point, radius);
        // Collision tests are expensive and costs are cheap: test in the order of cost.
        const auto first_free = std::ranges::find_if(
            near, [&](int i) { return problem_.is_move_free(at(i).position, point); });
        if (first_free == near.end()) return false;
        const int parent = *first_free;
        const double least = costThrough(parent, point);
        const int self = static_cast<int>(nodes_.size());
        nodes_.push_back({point, parent, least, parent});
        for (const int i : near) {
            const double cost = least + (at(i).position - point).norm();
            if (i == parent || cost >= at(i).cost) continue;
            if (!problem_.is_move_free(point, at(i).position)) continue;
            nodes_[i].parent = self;
            lower(i, at(i).cost - cost);
        }
        return true;
    }

    [[nodiscard]] const Node& at(int i) const { return nodes_[i]; }
    [[nodiscard]] int last() const { return static_cast<int>(nodes_.size()) - 1; }
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

  private:
    [[nodiscard]] double costThrough(int i, const Eigen::Vector3d& point) const {
        return at(i).cost + (at(i).position - point).norm();
    }

    /// Nodes within the radius, or the nearest one, by the cost of reaching the point through them.
    [[nodiscard]] std::vector<int> cheapestFirst(const Eigen::Vector3d& point,
                                                 double radius) const {
        std::vector<int> near = within(point, radius);
        if (near.empty()) near.push_back(nearest(point));
        std::vector<std::pair<double, int>> costs;
        costs.reserve(near.size());
        for (const int i : near) costs.emplace_back(costThrough(i, point), i);
        std::ranges::sort(costs);
        std::ranges::transform(costs, near.begin(), &std::pair<double, int>::second);
        return near;
    }

    [[nodiscard]] std::vector<int> within(const Eigen::Vector3d& point, double radius) const {
        std::vector<int> result;
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if ((nodes_[i].position - point).squaredNorm() < radius * radius) {
                result.push_back(static_cast<int>(i));
            }
        }
        return result;
    }

    /// Subtracts a gain from the costs of a node and all its descendants.
    void lower(int top, double gain) {
        std::vector<int> branch = {top};
        while (!branch.empty()) {
            const int i = branch.back();
            branch.pop_back();
            nodes_[i].cost -= gain;
            for (std::size_t child = 0; child < nodes_.size(); ++child) {
                if (nodes_[child].parent == i) branch.push_back(static_cast<int>(child));
            }
        }
    }

    const RrtStarProblem& problem_;
    std::vector<Node> nodes_;
};

}  // namespace

RrtStarResult rrtStar(const RrtStarProblem& problem, Random random) {
    Tree tree(problem);
    int best_end = -1;
    double best_cost = std::numeric_limits<double>::infinity();
    const auto tryGoal = [&](int node) {
        const double rest = (tree.at(node).position - problem.goal).norm();
        // Rewiring may have shortened the best path since it was found.
        if (best_end >= 0) {
            best_cost = tree.at(best_end).cost + (tree.at(best_end).position - problem.goal).norm();
        }
        if (tree.at(node).cost + rest >= best_cost) return;
        if (!problem.is_move_free(tree.at(node).position, problem.goal)) return;
        best_cost = tree.at(node).cost + rest;
        best_end = node;
        if (problem.on_shorter) problem.on_shorter(best_cost);
    };
    if (!problem.detour) tryGoal(0);
    int stop = problem.max_iterations;
    for (int i = 0; i < stop; ++i) {
        if (problem.is_cancelled && problem.is_cancelled()) break;
        const Eigen::Vector3d wish = problem.sample(random);
        // No path over this position can be shorter than the best one.
        if ((wish - problem.start).norm() + (wish - problem.goal).norm() >= best_cost) continue;
        const Eigen::Vector3d from = tree.at(tree.nearest(wish)).position;
        const double distance = (wish - from).norm();
        if (distance < 1e-6) continue;
        const Eigen::Vector3d whole = (wish - from) * std::min(1.0, kReach / distance);
        // In a narrow space nearly all long moves are blocked; a small tree tries short ones as
        // well.
        const auto addAt = [&](double share) {
            const Eigen::Vector3d point = from + share * whole;
            return problem.is_free(point) && tree.add(point);
        };
        const bool small = tree.last() < kSmallTree;
        if (!addAt(1.0) && !(small && addAt(kShorter))) continue;
        const bool was_found = best_end >= 0;
        tryGoal(tree.last());
        if (!was_found && best_end >= 0) {
            // Take the smaller of the remaining and the further iterations: adding to i could
            // overflow if the limit is the largest int.
            stop = i + std::min(stop - i, std::max(problem.improve_at_least, i / 2));
        }
    }
    RrtStarResult result;
    for (std::size_t i = 1; i < tree.nodes().size(); ++i) {
        result.samples.push_back(tree.nodes()[i].position);
        result.parents.push_back(tree.nodes()[i].first_parent - 1);
    }
    if (best_end < 0) return result;
    result.found = true;
    for (int node = best_end; node > 0; node = tree.at(node).parent) {
        result.corners.push_back(tree.at(node).position);
    }
    std::reverse(result.corners.begin(), result.corners.end());
    return result;
}

}  // namespace dollytrack::planning
