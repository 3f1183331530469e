#include "planning/path/roadmap_part.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace dollytrack::planning {

RoadmapPart::RoadmapPart(Roadmap& roadmap, const std::vector<PositionPoint>& points, int group)
    : roadmap_(&roadmap), points_(&points), local_(points.size(), -1) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (roadmap.group[i] != group) continue;
        local_[i] = static_cast<int>(keys.size());
        keys.push_back(static_cast<int>(i));
    }
    edges.resize(keys.size());
    for (std::size_t e = 0; e < roadmap.edges.size(); ++e) {
        const RoadmapEdge& edge = roadmap.edges[e];
        const int a = local_[edge.a];
        const int b = local_[edge.b];
        if (a < 0 || b < 0) continue;
        edges[a].push_back(static_cast<int>(e));
        edges[b].push_back(static_cast<int>(e));
    }
}

ShortestPaths shortestPathsFrom(const RoadmapPart& part, int start,
                                const std::function<double(const RoadmapEdge&)>& weigh) {
    ShortestPaths shortest{
        std::vector<double>(part.keys.size(), std::numeric_limits<double>::infinity()),
        std::vector<int>(part.keys.size(), -1)};
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        open;
    shortest.cost[start] = 0.0;
    open.emplace(0.0, start);
    while (!open.empty()) {
        const auto [cost, vertex] = open.top();
        open.pop();
        if (cost > shortest.cost[vertex]) continue;
        for (const int e : part.edges[vertex]) {
            const double length = weigh(part.edge(e));
            const std::size_t next = part.otherEnd(e, vertex);
            if (cost + length >= shortest.cost[next]) continue;
            shortest.cost[next] = cost + length;
            shortest.by_edge[next] = e;
            open.emplace(cost + length, static_cast<int>(next));
        }
    }
    return shortest;
}

std::vector<std::pair<int, int>> trace(const RoadmapPart& part, const ShortestPaths& shortest,
                                       int end) {
    std::vector<std::pair<int, int>> result;
    for (int vertex = end;;) {
        const int e = shortest.by_edge[vertex];
        result.emplace_back(vertex, e);
        if (e < 0) break;
        vertex = part.otherEnd(e, vertex);
    }
    std::reverse(result.begin(), result.end());
    return result;
}

std::vector<Eigen::Vector3d> cornersAlong(const RoadmapPart& part, int e, int to) {
    std::vector<Eigen::Vector3d> corners = part.edge(e).via;
    if (part.edge(e).b != part.keys[to]) {
        std::reverse(corners.begin(), corners.end());
    }
    return corners;
}

PathVertex keyVertex(const RoadmapPart& part, int vertex) {
    return {part.point(vertex).pose.position, part.keys[vertex]};
}

}  // namespace dollytrack::planning
