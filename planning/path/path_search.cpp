#include "planning/path/path_search.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/shortcut.h"
#include "planning/collision/swept_sphere.h"
#include "planning/path/length_budget.h"
#include "planning/path/tour.h"
#include "planning/plan_params.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace dollytrack::planning {
namespace {

/// One connected part of the roadmap, with its vertices numbered 0.. .
class Part {
  public:
    Part(Roadmap& roadmap, const std::vector<PositionPoint>& points, int group)
        : roadmap_(&roadmap), points_(&points), local_(points.size(), -1) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (roadmap.group[i] != group) continue;
            local_[i] = static_cast<int>(keys.size());
            keys.push_back(static_cast<int>(i));
        }
        edges.resize(keys.size());
        for (std::size_t e = 0; e < roadmap.edges.size(); ++e) {
            const RoadmapEdge& edge = roadmap.edges[e];
            const int a = local_[static_cast<std::size_t>(edge.a)];
            const int b = local_[static_cast<std::size_t>(edge.b)];
            if (a < 0 || b < 0) continue;
            edges[static_cast<std::size_t>(a)].push_back(static_cast<int>(e));
            edges[static_cast<std::size_t>(b)].push_back(static_cast<int>(e));
        }
    }

    [[nodiscard]] RoadmapEdge& edge(int e) const {
        return roadmap_->edges[static_cast<std::size_t>(e)];
    }
    [[nodiscard]] int otherEnd(int e, int vertex) const {
        const int a = local_[static_cast<std::size_t>(edge(e).a)];
        const int b = local_[static_cast<std::size_t>(edge(e).b)];
        return a == vertex ? b : a;
    }
    [[nodiscard]] const PositionPoint& point(int vertex) const {
        return (*points_)[static_cast<std::size_t>(keys[static_cast<std::size_t>(vertex)])];
    }
    [[nodiscard]] int size() const { return static_cast<int>(keys.size()); }
    /// The vertex of a position point; -1 when it is in another part, or none.
    [[nodiscard]] int vertexOf(int position_point) const {
        return position_point < 0 ? -1 : local_[static_cast<std::size_t>(position_point)];
    }

    std::vector<int> keys;                // position points, by local number
    std::vector<std::vector<int>> edges;  // roadmap edges at each vertex

  private:
    Roadmap* roadmap_;
    const std::vector<PositionPoint>* points_;
    std::vector<int> local_;
};

/// Depth-first search: edges to vertices already reached close a cycle and are dropped.
void dropCycleEdges(const Part& part) {
    std::vector<bool> reached(part.keys.size(), false);
    std::vector<int> stack = {0};
    for (const auto& at : part.edges) {
        for (const int e : at) part.edge(e).in_tree = false;
    }
    reached[0] = true;
    while (!stack.empty()) {
        const int vertex = stack.back();
        bool went_deeper = false;
        for (const int e : part.edges[static_cast<std::size_t>(vertex)]) {
            const int next = part.otherEnd(e, vertex);
            if (reached[static_cast<std::size_t>(next)]) continue;
            reached[static_cast<std::size_t>(next)] = true;
            part.edge(e).in_tree = true;
            stack.push_back(next);
            went_deeper = true;
            break;
        }
        if (!went_deeper) stack.pop_back();
    }
}

/// Cheapest ways from one vertex: for each vertex the cost and the edge it is reached by.
struct Ways {
    std::vector<double> cost;
    std::vector<int> by_edge;
};

Ways waysFrom(const Part& part, int start, const std::function<double(const RoadmapEdge&)>& weigh) {
    Ways ways{std::vector<double>(part.keys.size(), std::numeric_limits<double>::infinity()),
              std::vector<int>(part.keys.size(), -1)};
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        open;
    ways.cost[static_cast<std::size_t>(start)] = 0.0;
    open.emplace(0.0, start);
    while (!open.empty()) {
        const auto [cost, vertex] = open.top();
        open.pop();
        if (cost > ways.cost[static_cast<std::size_t>(vertex)]) continue;
        for (const int e : part.edges[static_cast<std::size_t>(vertex)]) {
            const double length = weigh(part.edge(e));
            const auto next = static_cast<std::size_t>(part.otherEnd(e, vertex));
            if (cost + length >= ways.cost[next]) continue;
            ways.cost[next] = cost + length;
            ways.by_edge[next] = e;
            open.emplace(cost + length, static_cast<int>(next));
        }
    }
    return ways;
}

double metres(const RoadmapEdge& edge) {
    return edge.length_m;
}

/// The vertices from the root of the ways to the end, with the edges between them.
std::vector<std::pair<int, int>> trace(const Part& part, const Ways& ways, int end) {
    std::vector<std::pair<int, int>> result;  // vertex, edge that leads to it
    for (int vertex = end;;) {
        const int e = ways.by_edge[static_cast<std::size_t>(vertex)];
        result.emplace_back(vertex, e);
        if (e < 0) break;
        vertex = part.otherEnd(e, vertex);
    }
    std::reverse(result.begin(), result.end());
    return result;
}

/// Corners from one vertex to another along an edge, both ends left out.
std::vector<Eigen::Vector3d> cornersAlong(const Part& part, int e, int to) {
    std::vector<Eigen::Vector3d> corners = part.edge(e).via;
    if (part.edge(e).b != part.keys[static_cast<std::size_t>(to)]) {
        std::reverse(corners.begin(), corners.end());
    }
    return corners;
}

PathVertex keyVertex(const Part& part, int vertex) {
    return {part.point(vertex).pose.position, part.keys[static_cast<std::size_t>(vertex)]};
}

/// The ends of one part's way, by its vertices; -1: any.
struct WayEnds {
    int first = -1;
    int last = -1;
    bool closed = false;  // back to the first
};

/// A walk along the tree's longest branch that leaves it for pinned points only, and comes back.
/// With ends given it is the longest branch from there, or the one between them.
class BranchWalk {
  public:
    BranchWalk(const Part& part, const std::vector<double>& weights, const WayEnds& ends)
        : part_(part), closed_(ends.closed), wanted_(part.keys.size(), false) {
        const auto weightOf = [&](int key) {
            return weights.empty() ? 1.0 : weights[static_cast<std::size_t>(key)];
        };
        // Half of each end's weight: along a way every vertex but its ends counts whole. What was
        // dropped leads nowhere.
        const auto steps = [&](const RoadmapEdge& edge) {
            return edge.in_tree ? 0.5 * (weightOf(edge.a) + weightOf(edge.b))
                                : std::numeric_limits<double>::infinity();
        };
        // In a tree the vertex furthest from anywhere is an end of the longest branch.
        const auto furthest = [&](const Ways& ways) {
            int best = 0;
            const auto worth = [&](int vertex) {
                const auto v = static_cast<std::size_t>(vertex);
                return ways.cost[v] + 0.5 * weightOf(part.keys[v]);
            };
            for (int vertex = 1; vertex < part.size(); ++vertex) {
                if (worth(vertex) > worth(best)) best = vertex;
            }
            return best;
        };
        const int one_end = ends.first >= 0  ? ends.first
                            : ends.last >= 0 ? furthest(waysFrom(part, ends.last, steps))
                                             : furthest(waysFrom(part, 0, steps));
        const Ways ways = waysFrom(part, one_end, steps);
        branch_ = trace(part, ways, ends.last >= 0 ? ends.last : furthest(ways));
        std::vector<bool> on_branch(part.keys.size(), false);
        for (const auto& [vertex, e] : branch_) on_branch[static_cast<std::size_t>(vertex)] = true;
        for (int i = 0; i < part.size(); ++i) {
            if (!part.point(i).fixed) continue;
            // Back from the pinned point to the branch: the detour it takes.
            const auto way = trace(part, ways, i);
            for (auto step = way.rbegin(); step != way.rend(); ++step) {
                const auto vertex = static_cast<std::size_t>(step->first);
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
        for (const int e : part_.edges[static_cast<std::size_t>(from)]) {
            const int next = part_.otherEnd(e, from);
            if (!part_.edge(e).in_tree || !wanted_[static_cast<std::size_t>(next)]) continue;
            wanted_[static_cast<std::size_t>(next)] = false;
            moveTo(next, e);
            path_.push_back(keyVertex(part_, next));
            makeDetours(next);
            moveTo(from, e);
            path_.push_back({part_.point(from).pose.position, -1});
        }
    }

    const Part& part_;
    bool closed_;
    std::vector<std::pair<int, int>> branch_;
    std::vector<bool> wanted_;
    std::vector<PathVertex> path_;
};

constexpr int kLengthAttempts = 6;
constexpr double kLengthUsed = 0.97;  // of the length allowed: near enough

/// A tour of one part in the making: the shortest ways between its key frames, and their order.
struct TourOfPart {
    std::vector<Ways> ways;     // from each vertex
    std::vector<int> vertices;  // by stop: a closed tour stops twice at its first
    BudgetedTour plan;
};

TourOfPart startTour(const Part& part, const RoadmapParams& weights, const WayEnds& ends,
                     const JobContext& job) {
    const auto count = part.keys.size();
    TourOfPart tour;
    tour.ways.resize(count);
    parallelFor(count,
                [&](std::size_t i) { tour.ways[i] = waysFrom(part, static_cast<int>(i), metres); });
    BudgetedTour& plan = tour.plan;
    plan.metres.assign(count, std::vector<double>(count, 0.0));
    plan.cost = plan.metres;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double turn = angleBetween(part.point(static_cast<int>(i)).pose.rotation,
                                             part.point(static_cast<int>(j)).pose.rotation);
            const double length = std::min(tour.ways[i].cost[j], tour.ways[j].cost[i]);
            plan.metres[i][j] = plan.metres[j][i] = length;
            plan.cost[i][j] = plan.cost[j][i] = weights.distance_weight * length + turn;
        }
        const PositionPoint& point = part.point(static_cast<int>(i));
        plan.shows.push_back(point.well_captured);
        plan.shows_less.push_back(point.captured);
        plan.fixed.push_back(point.pin >= 0);
        tour.vertices.push_back(static_cast<int>(i));
    }
    plan.ends = {ends.first, ends.last};
    if (ends.closed) {
        if (plan.ends.first < 0) plan.ends.first = 0;
        plan.ends.last = addCopyOfStop(plan, plan.ends.first);
        tour.vertices.push_back(plan.ends.first);
    }
    plan.order = shortTour(plan.cost, job, plan.ends);
    return tour;
}

std::vector<PathVertex> walk(const Part& part, const TourOfPart& tour, const SweptSphere& sphere) {
    std::vector<int> order;
    for (const int stop : tour.plan.order) {
        order.push_back(tour.vertices[static_cast<std::size_t>(stop)]);
    }
    std::vector<std::vector<Eigen::Vector3d>> legs(order.size());
    parallelFor(order.size(), [&](std::size_t i) {
        if (i == 0) return;
        const int from = order[i - 1];
        const int to = order[i];
        std::vector<Eigen::Vector3d> corners;
        for (const auto& [vertex, e] : trace(part, tour.ways[static_cast<std::size_t>(from)], to)) {
            if (e < 0) continue;
            for (const auto& corner : cornersAlong(part, e, vertex)) corners.push_back(corner);
            if (vertex != to) corners.push_back(part.point(vertex).pose.position);
        }
        legs[i] = shortened(corners, part.point(from).pose.position, part.point(to).pose.position,
                            sphere);
    });
    std::vector<PathVertex> path;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (const auto& corner : legs[i]) path.push_back({corner, -1});
        path.push_back(keyVertex(part, order[i]));
    }
    return path;
}

/// Metres that the camera goes, without the jumps between parts; smoothing cuts corners off it.
double lengthOf(const std::vector<std::vector<PathVertex>>& walks) {
    double sum = 0.0;
    for (const auto& walk : walks) {
        for (std::size_t i = 1; i < walk.size(); ++i) {
            sum += (walk[i].position - walk[i - 1].position).norm();
        }
    }
    return sum;
}

std::vector<std::vector<PathVertex>> walkAll(const std::vector<Part>& parts,
                                             const std::vector<TourOfPart>& tours,
                                             const SweptSphere& sphere) {
    std::vector<std::vector<PathVertex>> walks;
    for (std::size_t i = 0; i < parts.size(); ++i)
        walks.push_back(walk(parts[i], tours[i], sphere));
    return walks;
}

/// A tour of each part, together within the length allowed.
std::vector<std::vector<PathVertex>> takeTours(const std::vector<Part>& parts,
                                               const std::vector<WayEnds>& ends,
                                               const SweptSphere& sphere, double max_length_m,
                                               const RoadmapParams& weights,
                                               const JobContext& job) {
    std::vector<TourOfPart> tours;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        tours.push_back(startTour(parts[i], weights, ends[i], job));
    }
    auto walks = walkAll(parts, tours, sphere);
    double length = lengthOf(walks);
    if (max_length_m <= 0.0 || length <= max_length_m) return walks;
    // Ways along the roadmap are longer than what is walked, which skips corners: what they may
    // take is raised until the walk is about as long as allowed.
    const std::vector<TourOfPart> all = tours;
    double allowed = max_length_m;
    double enough = allowed;
    double too_much = 0.0;  // 0: not known yet
    for (int attempt = 0; attempt < kLengthAttempts && !job.cancelled(); ++attempt) {
        std::vector<BudgetedTour> plans;
        for (const TourOfPart& tour : all) plans.push_back(tour.plan);
        keepWithinLength(plans, allowed);
        for (std::size_t i = 0; i < tours.size(); ++i) tours[i].plan = std::move(plans[i]);
        auto next = walkAll(parts, tours, sphere);
        const double walked = lengthOf(next);
        const bool fits = walked <= max_length_m;
        if (fits || attempt == 0) walks = std::move(next);
        if (fits && (walked <= 0.0 || walked > kLengthUsed * max_length_m)) break;
        if (!fits && attempt == 0) break;  // what has to stay is too long
        (fits ? enough : too_much) = allowed;
        allowed = too_much > 0.0 ? 0.5 * (enough + too_much) : allowed * max_length_m / walked;
    }
    return walks;
}

void addPruneSteps(const Part& part, AlgorithmSteps& steps) {
    for (int vertex = 0; vertex < part.size(); ++vertex) {
        const int key = part.keys[static_cast<std::size_t>(vertex)];
        for (const int e : part.edges[static_cast<std::size_t>(vertex)]) {
            const RoadmapEdge& edge = part.edge(e);
            if (edge.in_tree || edge.a != key) continue;  // each edge once, at its first end
            steps.add({AlgorithmStep::Kind::Prune, edge.a, edge.b, e});
        }
    }
}

/// Where the way of each part begins and ends.
std::vector<WayEnds> endsOf(const std::vector<Part>& parts, const PathEnds& ends) {
    int spare = std::numeric_limits<int>::max();
    if (ends.visits > 0) {
        spare = ends.visits;
        for (const Part& part : parts) spare -= part.size();
    }
    std::vector<WayEnds> ways;
    for (const Part& part : parts) {
        WayEnds way{part.vertexOf(ends.start), part.vertexOf(ends.end)};
        if (way.last == way.first) way.last = -1;
        way.closed = ends.loop && part.size() > 1 && spare > 0;
        if (way.closed) --spare;
        ways.push_back(way);
    }
    return ways;
}

void addVisitSteps(const CameraPath& path, int index, AlgorithmSteps& steps) {
    int last = -1;
    for (const PathVertex& vertex : path.vertices) {
        if (vertex.position_point < 0) continue;
        AlgorithmStep step{AlgorithmStep::Kind::Visit, vertex.position_point, last, index};
        step.point = vertex.position.cast<float>();
        steps.add(step);
        last = vertex.position_point;
    }
}

}  // namespace

Result<std::vector<CameraPath>> takePaths(Roadmap& roadmap,
                                          const std::vector<PositionPoint>& position_points,
                                          const SweptSphere& sphere, const PathParams& params,
                                          const RoadmapParams& weights, const PathEnds& ends,
                                          const JobContext& job) {
    std::vector<Part> parts;
    for (int group = 0; group < roadmap.group_count; ++group) {
        parts.emplace_back(roadmap, position_points, group);
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.size() > b.size(); });
    // Rooms that have trajectories of their own in their order, largest first.
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
        return a.point(0).room < b.point(0).room;
    });
    const auto holds = [](int point) {
        return [point](const Part& part) { return part.vertexOf(point) >= 0; };
    };
    std::stable_partition(parts.begin(), parts.end(), [&](const Part& part) {
        return !holds(ends.end)(part) || holds(ends.start)(part);
    });
    std::stable_partition(parts.begin(), parts.end(), holds(ends.start));
    for (const Part& part : parts) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        dropCycleEdges(part);
        addPruneSteps(part, roadmap.steps);
    }
    const std::vector<WayEnds> ways = endsOf(parts, ends);
    std::vector<std::vector<PathVertex>> walks;
    if (params.path_mode == PathMode::LongestBranch) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            walks.push_back(BranchWalk(parts[i], ends.weights, ways[i]).walk());
        }
    } else {
        walks = takeTours(parts, ways, sphere, params.max_length_m, weights, job);
    }
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    std::vector<CameraPath> paths;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (walks[i].empty()) continue;  // no length left for this part
        CameraPath path;
        path.component = parts[i].point(0).component;
        path.room = parts[i].point(0).room;
        path.vertices = std::move(walks[i]);
        addVisitSteps(path, static_cast<int>(paths.size()), roadmap.steps);
        paths.push_back(std::move(path));
    }
    return paths;
}

}  // namespace dollytrack::planning
