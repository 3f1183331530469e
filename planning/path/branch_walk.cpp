#include "planning/path/branch_walk.h"

#include <limits>

namespace dollytrack::planning {
namespace {

class BranchWalk {
  public:
    BranchWalk(const RoadmapPart& part, const std::vector<double>& weights, const PartEnds& ends)
        : part_(part), closed_(ends.closed), wanted_(part.keys.size(), false) {
        const auto weightOf = [&](int key) { return weights.empty() ? 1.0 : weights[key]; };
        // Half of each end's weight, so that along a path every vertex but its ends counts fully.
        // Edges that are not in the tree are impassable.
        const auto steps = [&](const RoadmapEdge& edge) {
            return edge.in_tree ? 0.5 * (weightOf(edge.a) + weightOf(edge.b))
                                : std::numeric_limits<double>::infinity();
        };
        // In a tree the vertex farthest from any vertex is an end of the longest branch.
        const auto furthest = [&](const ShortestPaths& shortest) {
            int best = 0;
            const auto worth = [&](int vertex) {
                const std::size_t v = vertex;
                return shortest.cost[v] + 0.5 * weightOf(part.keys[v]);
            };
            for (int vertex = 1; vertex < part.size(); ++vertex) {
                if (worth(vertex) > worth(best)) best = vertex;
            }
            return best;
        };
        const int one_end = ends.first >= 0  ? ends.first
                            : ends.last >= 0 ? furthest(shortestPathsFrom(part, ends.last, steps))
                                             : furthest(shortestPathsFrom(part, 0, steps));
        const ShortestPaths shortest = shortestPathsFrom(part, one_end, steps);
        branch_ = trace(part, shortest, ends.last >= 0 ? ends.last : furthest(shortest));
        std::vector<bool> on_branch(part.keys.size(), false);
        for (const auto& [vertex, e] : branch_) on_branch[vertex] = true;
        for (int i = 0; i < part.size(); ++i) {
            if (!part.point(i).fixed) continue;
            // The detour from the branch to the fixed point.
            const auto way = trace(part, shortest, i);
            for (auto step = way.rbegin(); step != way.rend(); ++step) {
                const std::size_t vertex = step->first;
                if (on_branch[vertex] || wanted_[vertex]) break;
                wanted_[vertex] = true;
            }
        }
    }

    std::vector<PathVertex> walk() && {
        for (const auto& [vertex, e] : branch_) {
            moveTo(vertex, e);
            path_.push_back(keyVertex(part_, vertex));
            makeDetours(vertex);
        }
        for (std::size_t i = branch_.size(); closed_ && i-- > 1;) {
            const int vertex = branch_[i - 1].first;
            moveTo(vertex, branch_[i].second);
            path_.push_back({part_.point(vertex).pose.position, -1});
        }
        if (closed_) path_.back() = keyVertex(part_, branch_.front().first);
        return std::move(path_);
    }

  private:
    void moveTo(int vertex, int e) {
        if (e < 0) return;
        for (const auto& corner : cornersAlong(part_, e, vertex)) path_.push_back({corner, -1});
    }

    void makeDetours(int from) {
        for (const int e : part_.edges[from]) {
            const int next = part_.otherEnd(e, from);
            if (!part_.edge(e).in_tree || !wanted_[next]) continue;
            wanted_[next] = false;
            moveTo(next, e);
            path_.push_back(keyVertex(part_, next));
            makeDetours(next);
            moveTo(from, e);
            path_.push_back({part_.point(from).pose.position, -1});
        }
    }

    const RoadmapPart& part_;
    bool closed_;
    std::vector<std::pair<int, int>> branch_;
    std::vector<bool> wanted_;
    std::vector<PathVertex> path_;
};

}  // namespace

std::vector<PathVertex> walkBranch(const RoadmapPart& part, const std::vector<double>& weights,
                                   const PartEnds& ends) {
    return BranchWalk(part, weights, ends).walk();
}

}  // namespace dollytrack::planning
