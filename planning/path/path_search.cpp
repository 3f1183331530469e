#include "planning/path/path_search.h"

#include "planning/path/branch_walk.h"
#include "planning/path/roadmap_part.h"
#include "planning/path/tour_walk.h"
#include "planning/plan_params.h"

#include <algorithm>
#include <limits>

namespace dollytrack::planning {
namespace {

/// Depth-first search: edges to vertices already reached close a cycle and leave the tree.
void dropCycleEdges(const RoadmapPart& part) {
    std::vector<bool> reached(part.keys.size(), false);
    std::vector<int> stack = {0};
    for (const auto& at : part.edges) {
        for (const int e : at) part.edge(e).in_tree = false;
    }
    reached[0] = true;
    while (!stack.empty()) {
        const int vertex = stack.back();
        bool went_deeper = false;
        for (const int e : part.edges[vertex]) {
            const int next = part.otherEnd(e, vertex);
            if (reached[next]) continue;
            reached[next] = true;
            part.edge(e).in_tree = true;
            stack.push_back(next);
            went_deeper = true;
            break;
        }
        if (!went_deeper) stack.pop_back();
    }
}

void addPruneSteps(const RoadmapPart& part, AlgorithmSteps& steps) {
    for (int vertex = 0; vertex < part.size(); ++vertex) {
        const int key = part.keys[vertex];
        for (const int e : part.edges[vertex]) {
            const RoadmapEdge& edge = part.edge(e);
            if (edge.in_tree || edge.a != key) continue;  // each edge once, at its first end
            steps.add({AlgorithmStep::Kind::Prune, edge.a, edge.b, e});
        }
    }
}

/// The ends of each part's path.
std::vector<PartEnds> endsOf(const std::vector<RoadmapPart>& parts, const PathEnds& ends) {
    int spare = std::numeric_limits<int>::max();
    if (ends.visits > 0 && !ends.chosen_by_tour) {
        spare = ends.visits;
        for (const RoadmapPart& part : parts) spare -= part.size();
    }
    std::vector<PartEnds> part_ends;
    for (const RoadmapPart& part : parts) {
        PartEnds part_end{part.vertexOf(ends.start), part.vertexOf(ends.end)};
        if (part_end.last == part_end.first) part_end.last = -1;
        part_end.closed = ends.loop && part.size() > 1 && spare > 0;
        if (part_end.closed) --spare;
        part_ends.push_back(part_end);
    }
    return part_ends;
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
    std::vector<RoadmapPart> parts;
    for (int group = 0; group < roadmap.group_count; ++group) {
        parts.emplace_back(roadmap, position_points, group);
    }
    std::stable_sort(parts.begin(), parts.end(), [](const RoadmapPart& a, const RoadmapPart& b) {
        return a.size() > b.size();
    });
    // Sort by room, if each room has its own trajectory; rooms are numbered by size.
    std::stable_sort(parts.begin(), parts.end(), [](const RoadmapPart& a, const RoadmapPart& b) {
        return a.point(0).room < b.point(0).room;
    });
    const auto holds = [](int point) {
        return [point](const RoadmapPart& part) { return part.vertexOf(point) >= 0; };
    };
    std::stable_partition(parts.begin(), parts.end(), [&](const RoadmapPart& part) {
        return !holds(ends.end)(part) || holds(ends.start)(part);
    });
    std::stable_partition(parts.begin(), parts.end(), holds(ends.start));
    for (const RoadmapPart& part : parts) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        dropCycleEdges(part);
        addPruneSteps(part, roadmap.steps);
    }
    const std::vector<PartEnds> part_ends = endsOf(parts, ends);
    std::vector<std::vector<PathVertex>> walks;
    if (params.path_mode == PathMode::LongestBranch) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            walks.push_back(walkBranch(parts[i], ends.weights, part_ends[i]));
        }
    } else {
        const TourBudget budget{params.max_length_m,   ends.chosen_by_tour ? ends.visits : 0,
                                ends.object_weights,   ends.rank,
                                ends.avoided,          ends.smooth_length_m,
                                ends.corner_distance_m};
        walks = walkTours(parts, part_ends, sphere, budget, weights, job);
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
