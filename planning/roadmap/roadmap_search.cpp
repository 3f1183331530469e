#include "planning/roadmap/roadmap_search.h"

#include "engine/core/disjoint_sets.h"
#include "engine/core/random.h"
#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/plan_params.h"

#include <algorithm>
#include <numeric>

namespace dollytrack::planning {
namespace {

// A few edges per sample make the tours short; more would only cost time.
constexpr int kEdgesPerSample = 4;

/// A pair of key frames and whether the move between them is free. The search is sequential, since
/// each choice depends on earlier edges, but collision tests are not: those of the pairs that the
/// search can ask for are made beforehand, in parallel.
struct Pair {
    int a = 0;
    int b = 0;
    SweepResult sweep;
};

/// The three terms of Near's cost.
struct Cost {
    double distance_m = 0.0;
    double distance = 0.0;
    double size = 0.0;
    double turn = 0.0;
    [[nodiscard]] double sum() const { return distance + size + turn; }
};

Cost cost(const PositionPoint& near, const PositionPoint& sample, double near_size,
          const RoadmapParams& params) {
    const double distance = (near.pose.position - sample.pose.position).norm();
    return {distance, params.distance_weight * distance, params.size_weight * near_size,
            angleBetween(near.pose.forward(), sample.pose.forward())};
}

/// Other key frames of the same component and room, in the order in which Near returns them.
std::vector<int> byPriority(const std::vector<PositionPoint>& points, const std::vector<int>& keys,
                            const std::vector<double>& sizes, int sample,
                            const RoadmapParams& params) {
    const auto at = [&](int i) -> const PositionPoint& { return points[i]; };
    std::vector<std::pair<double, int>> order;
    for (const int other : keys) {
        if (other == sample || at(other).component != at(sample).component) continue;
        if (at(other).room != at(sample).room) continue;
        order.emplace_back(cost(at(other), at(sample), sizes[other], params).sum(), other);
    }
    std::sort(order.begin(), order.end());
    std::vector<int> result;
    for (const auto& [_, other] : order) result.push_back(other);
    return result;
}

/// Adds the steps Near, Edge and CollisionFree. Call before adding the edge or the refused edge.
void addEdgeSteps(Roadmap& roadmap, int sample, int near, const Cost& terms,
                  const SweepResult& sweep) {
    using Kind = AlgorithmStep::Kind;
    AlgorithmStep step{Kind::Near, sample, near};
    step.distance_m = static_cast<float>(terms.distance_m);
    step.distance_cost = static_cast<float>(terms.distance);
    step.size_cost = static_cast<float>(terms.size);
    step.turn_cost = static_cast<float>(terms.turn);
    roadmap.steps.add(step);
    roadmap.steps.add({Kind::Edge, sample, near});
    AlgorithmStep outcome{sweep.free ? Kind::Accepted : Kind::Refused, sample, near};
    outcome.index =
        static_cast<std::int32_t>(sweep.free ? roadmap.edges.size() : roadmap.refused.size());
    outcome.point = sweep.collision.cast<float>();
    roadmap.steps.add(outcome);
}

}  // namespace

std::vector<double> targetSizes(const Scene& scene,
                                const std::vector<ObservationPoint>& observation_points,
                                const std::vector<PositionPoint>& position_points) {
    std::vector<double> sizes;
    for (const PositionPoint& point : position_points) {
        Eigen::AlignedBox3d box;
        const std::size_t o = point.observation_point;
        for (const int id : observation_points[o].objects) {
            for (const Eigen::Vector3d& corner : scene.object(id).box.corners()) box.extend(corner);
        }
        // A view placed by hand may have no objects.
        sizes.push_back(box.isEmpty() ? 0.0 : box.sizes().norm());
    }
    return sizes;
}

Result<Roadmap> searchRoadmap(const std::vector<PositionPoint>& position_points,
                              const std::vector<int>& key_frames, const std::vector<double>& sizes,
                              const SweptSphere& sphere, const RoadmapParams& params, int seed,
                              const JobContext& job) {
    const auto position = [&](int i) -> const Eigen::Vector3d& {
        return position_points[i].pose.position;
    };
    // Samples never need more partners: they reach their limit of edges or refusals before.
    std::vector<std::vector<int>> partners(key_frames.size());
    parallelFor(key_frames.size(), [&](std::size_t i) {
        partners[i] = byPriority(position_points, key_frames, sizes, key_frames[i], params);
        const std::size_t tried = params.refusal_limit + kEdgesPerSample;
        if (partners[i].size() > tried) partners[i].resize(tried);
    });
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < key_frames.size(); ++i) {
        for (const int other : partners[i]) {
            pairs.push_back({std::min(key_frames[i], other), std::max(key_frames[i], other), {}});
        }
    }
    const auto ends = [](const Pair& p) { return std::pair(p.a, p.b); };
    std::sort(pairs.begin(), pairs.end(),
              [&](const Pair& x, const Pair& y) { return ends(x) < ends(y); });
    pairs.erase(std::unique(pairs.begin(), pairs.end(),
                            [&](const Pair& x, const Pair& y) { return ends(x) == ends(y); }),
                pairs.end());
    parallelFor(pairs.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        pairs[i].sweep = sphere.segment(position(pairs[i].a), position(pairs[i].b));
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");

    // Sample: a random order of all key frames, so that each is sampled once.
    std::vector<std::size_t> order(key_frames.size());
    std::iota(order.begin(), order.end(), 0U);
    Random random(static_cast<std::uint64_t>(seed), 1);
    for (std::size_t i = order.size(); i > 1; --i) {
        std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    }
    using Step = AlgorithmStep::Kind;
    Roadmap roadmap;
    std::vector<bool> used(pairs.size(), false);
    for (const std::size_t i : order) {
        int refusals = 0;
        int joined = 0;
        roadmap.steps.add({Step::Sample, key_frames[i]});
        for (const int near : partners[i]) {
            if (refusals >= params.refusal_limit || joined >= kEdgesPerSample) break;
            const std::pair wanted(std::min(key_frames[i], near), std::max(key_frames[i], near));
            const auto found =
                std::lower_bound(pairs.begin(), pairs.end(), wanted,
                                 [&](const Pair& p, const auto& value) { return ends(p) < value; });
            const std::size_t index = found - pairs.begin();
            if (used[index]) {
                roadmap.steps.add({Step::Skip, key_frames[i], near});
                continue;
            }
            used[index] = true;
            const Pair& pair = *found;
            ++(pair.sweep.free ? joined : refusals);
            const auto point = [&](int p) -> const PositionPoint& { return position_points[p]; };
            addEdgeSteps(roadmap, key_frames[i], near,
                         cost(point(near), point(key_frames[i]), sizes[near], params), pair.sweep);
            if (pair.sweep.free) {
                roadmap.edges.push_back(
                    {pair.a, pair.b, {}, (position(pair.a) - position(pair.b)).norm(), true});
            } else {
                roadmap.refused.push_back({pair.a, pair.b, pair.sweep.collision,
                                           pair.sweep.object_id, pair.sweep.reason});
            }
        }
        roadmap.steps.add({Step::Leave, key_frames[i], -1, refusals});
    }
    findGroups(roadmap, position_points.size(), key_frames);
    return roadmap;
}

void findGroups(Roadmap& roadmap, std::size_t position_point_count,
                const std::vector<int>& key_frames) {
    DisjointSets<int> connected(position_point_count);
    for (const RoadmapEdge& edge : roadmap.edges) connected.join(edge.a, edge.b);
    std::vector<int> keys = key_frames;
    std::sort(keys.begin(), keys.end());
    roadmap.group.assign(position_point_count, -1);
    roadmap.group_count = 0;
    for (const int key : keys) {
        int& first = roadmap.group[connected.find(key)];
        if (first < 0) first = roadmap.group_count++;
        roadmap.group[key] = first;
    }
}

}  // namespace dollytrack::planning
