#pragma once

#include "engine/plan/plan.h"

#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace dollytrack::planning {

/// One connected part of the roadmap, with vertices numbered from 0. Keeps references.
class RoadmapPart {
  public:
    RoadmapPart(Roadmap& roadmap, const std::vector<PositionPoint>& points, int group);

    [[nodiscard]] RoadmapEdge& edge(int e) const { return roadmap_->edges[e]; }
    [[nodiscard]] int otherEnd(int e, int vertex) const {
        const int a = local_[edge(e).a];
        const int b = local_[edge(e).b];
        return a == vertex ? b : a;
    }
    [[nodiscard]] const PositionPoint& point(int vertex) const { return (*points_)[keys[vertex]]; }
    [[nodiscard]] int size() const { return static_cast<int>(keys.size()); }
    /// The vertex of a position point; -1 if it is in another part or negative.
    [[nodiscard]] int vertexOf(int position_point) const {
        return position_point < 0 ? -1 : local_[position_point];
    }

    std::vector<int> keys;                // position points, by vertex
    std::vector<std::vector<int>> edges;  // indices of roadmap edges, by vertex

  private:
    Roadmap* roadmap_;
    const std::vector<PositionPoint>* points_;
    std::vector<int> local_;
};

/// Ends of one part's path, as vertices; -1: any.
struct PartEnds {
    int first = -1;
    int last = -1;
    bool closed = false;  // returns to the first
};

/// Shortest-path tree from one vertex (Dijkstra): by vertex, the cost and the edge that leads to it
/// (-1: none).
struct ShortestPaths {
    std::vector<double> cost;
    std::vector<int> by_edge;
};

ShortestPaths shortestPathsFrom(const RoadmapPart& part, int start,
                                const std::function<double(const RoadmapEdge&)>& weigh);

/// The vertices from the root of the tree to `end`, each with the edge that leads to it; -1 at the
/// root.
std::vector<std::pair<int, int>> trace(const RoadmapPart& part, const ShortestPaths& shortest,
                                       int end);

/// Inner corners of an edge, in the direction towards the vertex `to`.
std::vector<Eigen::Vector3d> cornersAlong(const RoadmapPart& part, int edge, int to);

PathVertex keyVertex(const RoadmapPart& part, int vertex);

}  // namespace dollytrack::planning
