#include "planning/path/tour_walk.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/shortcut.h"
#include "planning/collision/swept_sphere.h"
#include "planning/path/length_budget.h"
#include "planning/plan_params.h"

#include <algorithm>
#include <map>
#include <utility>

namespace dollytrack::planning {
namespace {

double metres(const RoadmapEdge& edge) {
    return edge.length_m;
}

constexpr double kMostCut = 1.4;  // relative to the allowed length: smoothing may shorten a walk by
                                  // up to this factor

/// A tour of one part: shortest paths between its key frames, and their order.
struct TourOfPart {
    std::vector<ShortestPaths> shortest;  // from each vertex
    std::vector<int> vertices;            // by stop; a closed tour contains its first vertex twice
    BudgetedTour plan;
};

TourOfPart startTour(const RoadmapPart& part, const RoadmapParams& weights, const PartEnds& ends,
                     const TourBudget& budget, const JobContext& job) {
    const auto count = part.keys.size();
    TourOfPart tour;
    tour.shortest.resize(count);
    parallelFor(count, [&](std::size_t i) {
        tour.shortest[i] = shortestPathsFrom(part, static_cast<int>(i), metres);
    });
    BudgetedTour& plan = tour.plan;
    plan.metres.assign(count, std::vector<double>(count, 0.0));
    plan.cost = plan.metres;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double turn = angleBetween(part.point(static_cast<int>(i)).pose.rotation,
                                             part.point(static_cast<int>(j)).pose.rotation);
            const double length = std::min(tour.shortest[i].cost[j], tour.shortest[j].cost[i]);
            plan.metres[i][j] = plan.metres[j][i] = length;
            plan.cost[i][j] = plan.cost[j][i] = weights.distance_weight * length + turn;
        }
        const PositionPoint& point = part.point(static_cast<int>(i));
        const bool counts = !budget.avoided.contains(part.keys[i]);
        plan.shows.push_back(counts ? point.well_captured : std::vector<int>());
        plan.shows_less.push_back(counts ? point.captured : std::vector<int>());
        if (counts && ((point.fixed && point.pin < 0) || point.surface_view)) {
            // A constraint viewpoint, of a must-see region, an anchor or surface, is worth as much
            // as an object.
            const int asked = -1 - part.keys[i];
            plan.shows.back().push_back(asked);
            plan.shows_less.back().push_back(asked);
        }
        plan.fixed.push_back(point.pin >= 0);
        tour.vertices.push_back(static_cast<int>(i));
        if (!budget.rank.empty()) plan.rank.push_back(budget.rank[part.keys[i]]);
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

/// The legs between stops, without corners of the roadmap that can be skipped. Candidate tours
/// share most legs, so each is made once.
class Legs {
  public:
    Legs(const RoadmapPart& part, const TourOfPart& tour, const SweptSphere& sphere)
        : part_(part), tour_(tour), sphere_(sphere) {}

    /// Length of the walk through these stops, m, before smoothing.
    double lengthOf(const std::vector<int>& order) {
        make(order);
        double sum = 0.0;
        for (std::size_t i = 1; i < order.size(); ++i) sum += leg(order[i - 1], order[i]).metres;
        return sum;
    }

    /// Sum of the straight distances between the stops, a lower bound of the walk's length.
    [[nodiscard]] double leastLengthOf(const std::vector<int>& order) const {
        double sum = 0.0;
        for (std::size_t i = 1; i < order.size(); ++i) {
            sum += (position(order[i]) - position(order[i - 1])).norm();
        }
        return sum;
    }

    std::vector<PathVertex> walk(const std::vector<int>& order) {
        make(order);
        std::vector<PathVertex> path;
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i > 0) {
                for (const auto& corner : leg(order[i - 1], order[i]).corners) {
                    path.push_back({corner, -1});
                }
            }
            path.push_back(keyVertex(part_, vertex(order[i])));
        }
        return path;
    }

  private:
    struct Leg {
        std::vector<Eigen::Vector3d> corners;
        double metres = 0.0;
    };

    [[nodiscard]] int vertex(int stop) const { return tour_.vertices[stop]; }
    [[nodiscard]] const Eigen::Vector3d& position(int stop) const {
        return part_.point(vertex(stop)).pose.position;
    }
    [[nodiscard]] const Leg& leg(int from, int to) const { return legs_.at({from, to}); }

    void make(const std::vector<int>& order) {
        std::vector<std::pair<int, int>> missing;
        for (std::size_t i = 1; i < order.size(); ++i) {
            const std::pair between(order[i - 1], order[i]);
            if (!legs_.contains(between)) missing.push_back(between);
        }
        std::vector<Leg> made(missing.size());
        parallelFor(missing.size(), [&](std::size_t i) {
            made[i] = makeLeg(vertex(missing[i].first), vertex(missing[i].second));
        });
        for (std::size_t i = 0; i < missing.size(); ++i) {
            legs_.emplace(missing[i], std::move(made[i]));
        }
    }

    [[nodiscard]] Leg makeLeg(int from, int to) const {
        const Eigen::Vector3d& start = part_.point(from).pose.position;
        const Eigen::Vector3d& end = part_.point(to).pose.position;
        std::vector<Eigen::Vector3d> corners;
        for (const auto& [vertex, e] : trace(part_, tour_.shortest[from], to)) {
            if (e < 0) continue;
            for (const auto& corner : cornersAlong(part_, e, vertex)) corners.push_back(corner);
            if (vertex != to) corners.push_back(part_.point(vertex).pose.position);
        }
        Leg leg;
        leg.corners = shortened(corners, start, end, sphere_);
        const Eigen::Vector3d* last = &start;
        for (const Eigen::Vector3d& corner : leg.corners) {
            leg.metres += (corner - *last).norm();
            last = &corner;
        }
        leg.metres += (end - *last).norm();
        return leg;
    }

    const RoadmapPart& part_;
    const TourOfPart& tour_;
    const SweptSphere& sphere_;
    std::map<std::pair<int, int>, Leg> legs_;
};

/// Lower bound of the walk's length after smoothing, m: every corner cut by the largest set-back.
double leastFlown(const std::vector<PathVertex>& walk, double corner_distance_m) {
    double sum = 0.0;
    for (std::size_t i = 1; i < walk.size(); ++i) {
        const Eigen::Vector3d in = walk[i].position - walk[i - 1].position;
        sum += in.norm();
        if (i + 1 == walk.size()) break;
        const Eigen::Vector3d out = walk[i + 1].position - walk[i].position;
        const double back = std::min({corner_distance_m, 0.5 * in.norm(), 0.5 * out.norm()});
        if (back <= 0.0) continue;
        SmoothPath curve;
        curve.append(-back * in.normalized(), Eigen::Vector3d::Zero(), back * out.normalized(),
                     true);
        sum -= 2.0 * back - curve.length_m;
    }
    return sum;
}

template <class Measure>
double sumOver(std::vector<Legs>& legs, const TourChoice& choice, const Measure& measure) {
    double sum = 0.0;
    for (std::size_t i = 0; i < legs.size(); ++i) sum += measure(legs[i], choice.orders[i]);
    return sum;
}

/// The tours of highest worth that fit the budget after smoothing.
TourChoice choose(const std::vector<TourOfPart>& tours, std::vector<Legs>& legs,
                  const TourBudget& budget, const JobContext& job) {
    TourChoice all;
    for (const TourOfPart& tour : tours) {
        all.orders.push_back(tour.plan.order);
        all.stops += static_cast<int>(tour.plan.order.size());
    }
    const auto length = [](Legs& one, const std::vector<int>& order) {
        return one.lengthOf(order);
    };
    const auto fits = [&](const TourChoice& choice) {
        if (budget.max_stops > 0 && choice.stops > budget.max_stops) return false;
        const double least = sumOver(legs, choice, [](Legs& one, const std::vector<int>& order) {
            return one.leastLengthOf(order);
        });
        if (least > kMostCut * budget.max_length_m) return false;
        const double walked = sumOver(legs, choice, length);
        if (walked <= budget.max_length_m) return true;
        if (!budget.smooth_length_m || walked > kMostCut * budget.max_length_m) return false;
        const double at_least =
            sumOver(legs, choice, [&](Legs& one, const std::vector<int>& order) {
                return leastFlown(one.walk(order), budget.corner_distance_m);
            });
        return at_least <= budget.max_length_m &&
               sumOver(legs, choice, [&](Legs& one, const std::vector<int>& order) {
                   CameraPath path;
                   path.vertices = one.walk(order);
                   return path.vertices.empty() ? 0.0 : budget.smooth_length_m(path);
               }) <= budget.max_length_m;
    };
    if (budget.max_length_m <= 0.0 || fits(all)) return all;
    std::vector<BudgetedTour> plans;
    for (const TourOfPart& tour : tours) plans.push_back(tour.plan);
    std::vector<TourChoice> choices =
        tourChoices(plans, budget.max_length_m, budget.object_weights);
    for (TourChoice& choice : choices) {
        if (job.cancelled() || fits(choice)) return std::move(choice);
    }
    // The fixed stops exceed the budget.
    return std::move(*std::ranges::min_element(choices, [](const auto& a, const auto& b) {
        return std::pair(a.stops, a.metres) < std::pair(b.stops, b.metres);
    }));
}

}  // namespace

std::vector<std::vector<PathVertex>> walkTours(const std::vector<RoadmapPart>& parts,
                                               const std::vector<PartEnds>& ends,
                                               const SweptSphere& sphere, const TourBudget& budget,
                                               const RoadmapParams& weights,
                                               const JobContext& job) {
    std::vector<TourOfPart> tours;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        tours.push_back(startTour(parts[i], weights, ends[i], budget, job));
    }
    std::vector<Legs> legs;
    for (std::size_t i = 0; i < parts.size(); ++i) legs.emplace_back(parts[i], tours[i], sphere);
    const TourChoice chosen = choose(tours, legs, budget, job);
    std::vector<std::vector<PathVertex>> walks;
    for (std::size_t i = 0; i < parts.size(); ++i) walks.push_back(legs[i].walk(chosen.orders[i]));
    return walks;
}

}  // namespace dollytrack::planning
