#include "planning/path/tour_walk.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/shortcut.h"
#include "planning/collision/swept_sphere.h"
#include "planning/path/length_budget.h"
#include "planning/plan_params.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

double metres(const RoadmapEdge& edge) {
    return edge.length_m;
}

constexpr int kLengthAttempts = 6;
constexpr double kLengthUsed = 0.97;  // of the length allowed: near enough

/// A tour of one part in the making: the shortest ways between its key frames, and their order.
struct TourOfPart {
    std::vector<Ways> ways;     // from each vertex
    std::vector<int> vertices;  // by stop: a closed tour stops twice at its first
    BudgetedTour plan;
};

TourOfPart startTour(const RoadmapPart& part, const RoadmapParams& weights, const WayEnds& ends,
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
        if (point.fixed && point.pin < 0) {
            // What is asked for beside objects, of a must-see region or an anchor, is worth one.
            const int asked = -1 - part.keys[i];
            plan.shows.back().push_back(asked);
            plan.shows_less.back().push_back(asked);
        }
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

std::vector<PathVertex> walk(const RoadmapPart& part, const TourOfPart& tour,
                             const SweptSphere& sphere) {
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

std::vector<std::vector<PathVertex>> walkAll(const std::vector<RoadmapPart>& parts,
                                             const std::vector<TourOfPart>& tours,
                                             const SweptSphere& sphere) {
    std::vector<std::vector<PathVertex>> walks;
    for (std::size_t i = 0; i < parts.size(); ++i)
        walks.push_back(walk(parts[i], tours[i], sphere));
    return walks;
}

}  // namespace

std::vector<std::vector<PathVertex>> walkTours(const std::vector<RoadmapPart>& parts,
                                               const std::vector<WayEnds>& ends,
                                               const SweptSphere& sphere,
                                               const LengthBudget& budget,
                                               const RoadmapParams& weights,
                                               const JobContext& job) {
    std::vector<TourOfPart> tours;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        tours.push_back(startTour(parts[i], weights, ends[i], job));
    }
    auto walks = walkAll(parts, tours, sphere);
    double length = lengthOf(walks);
    if (budget.max_length_m <= 0.0 || length <= budget.max_length_m) return walks;
    // Ways along the roadmap are longer than what is walked, which skips corners: what they may
    // take is raised until the walk is about as long as allowed.
    const std::vector<TourOfPart> all = tours;
    double allowed = budget.max_length_m;
    double enough = allowed;
    double too_much = 0.0;  // 0: not known yet
    double most = -1.0;     // worth of what fits
    for (int attempt = 0; attempt < kLengthAttempts && !job.cancelled(); ++attempt) {
        std::vector<BudgetedTour> plans;
        for (const TourOfPart& tour : all) plans.push_back(tour.plan);
        const double worth = keepWithinLength(plans, allowed, budget.object_weights);
        for (std::size_t i = 0; i < tours.size(); ++i) tours[i].plan = std::move(plans[i]);
        auto next = walkAll(parts, tours, sphere);
        const double walked = lengthOf(next);
        const bool fits = walked <= budget.max_length_m;
        if (attempt == 0 || (fits && worth >= most)) {
            walks = std::move(next);
            most = worth;
        }
        if (fits && (walked <= 0.0 || walked > kLengthUsed * budget.max_length_m)) break;
        if (!fits && attempt == 0) break;  // what has to stay is too long
        (fits ? enough : too_much) = allowed;
        allowed =
            too_much > 0.0 ? 0.5 * (enough + too_much) : allowed * budget.max_length_m / walked;
    }
    return walks;
}

}  // namespace dollytrack::planning
