#include "planning/linking/link_groups.h"

#include "planning/collision/shortcut.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/linking/rrt_star.h"
#include "planning/plan_params.h"
#include "planning/roadmap/roadmap_search.h"

#include <algorithm>
#include <memory>
#include <set>
#include <tuple>

namespace dollytrack::planning {
namespace {

// Pairs of ends tried for a part before it is left separate.
constexpr int kPairsTried = 6;
constexpr double kUniformShare = 0.2;

/// The paper's chain of samples around the two ends, mixed with uniform samples.
class ChainSampler {
  public:
    ChainSampler(const FreeSpace& free_space, const SweptSphere& sphere, int component,
                 Eigen::Vector3d p1, Eigen::Vector3d p2, double sigma)
        : cells_(sphere.cells(component)),
          sphere_(sphere),
          free_space_(free_space),
          component_(component),
          heads_{p1, p2},
          origins_{p1, p2},
          sigma_(sigma) {}

    Eigen::Vector3d operator()(Random& random) {
        if (random.uniform() < kUniformShare && !cells_.empty()) {
            return cells_[random.below(static_cast<std::uint32_t>(cells_.size()))].cast<double>();
        }
        const std::size_t side = random.below(2);
        const Eigen::Vector3d step(random.normal(), random.normal(), random.normal());
        const Eigen::Vector3d next = sphere_.inBand(heads_[side] + sigma_ * step);
        if (free_space_.componentAt(next) == component_) {
            heads_[side] = next;
            refusals_[side] = 0;
        } else if (++refusals_[side] > kPatience) {
            // Restart a chain that is stuck in a corner.
            heads_[side] = origins_[side];
            refusals_[side] = 0;
        }
        return next;
    }

  private:
    static constexpr int kPatience = 12;
    const std::vector<Eigen::Vector3f>& cells_;
    const SweptSphere& sphere_;
    const FreeSpace& free_space_;
    int component_;
    Eigen::Vector3d heads_[2];
    Eigen::Vector3d origins_[2];
    int refusals_[2] = {0, 0};
    double sigma_;
};

struct Ends {
    double distance = 0.0;
    int a = 0;
    int b = 0;
    bool operator<(const Ends& other) const {
        return std::tie(distance, a, b) < std::tie(other.distance, other.a, other.b);
    }
};

/// Closest pairs of the group's key frames with those of other groups in the same component and
/// room, at most kPairsTried.
std::vector<Ends> closestEnds(const Roadmap& roadmap, const std::vector<PositionPoint>& points,
                              const std::vector<int>& keys, int group) {
    std::vector<Ends> ends;
    for (const int a : keys) {
        if (roadmap.group[a] != group) continue;
        for (const int b : keys) {
            const PositionPoint& pa = points[a];
            const PositionPoint& pb = points[b];
            if (roadmap.group[b] == group) continue;
            if (pa.component != pb.component || pa.room != pb.room) continue;
            ends.push_back({(pa.pose.position - pb.pose.position).norm(), a, b});
        }
    }
    const auto count = std::min<std::size_t>(kPairsTried, ends.size());
    std::partial_sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count), ends.end());
    ends.resize(count);
    return ends;
}

using StepKind = AlgorithmStep::Kind;

/// Adds the samples of one link to the roadmap, and the steps that made them.
void addSamples(Roadmap& roadmap, const RrtStarResult& way, const Ends& pair,
                const Eigen::Vector3d& start) {
    roadmap.steps.add({StepKind::Link, pair.a, pair.b});
    const int first = static_cast<int>(roadmap.samples.size());
    for (std::size_t i = 0; i < way.samples.size(); ++i) {
        const int parent = way.parents[i];
        AlgorithmStep step{StepKind::LinkSample, pair.a, pair.b};
        step.index = first + static_cast<int>(i);
        step.parent = parent < 0 ? -1 : first + parent;
        step.point = way.samples[i].cast<float>();
        step.from = (parent < 0 ? start : way.samples[parent]).cast<float>();
        roadmap.steps.add(step);
        roadmap.samples.push_back(way.samples[i]);
        roadmap.sample_parents.push_back(step.parent);
    }
}

}  // namespace

Status linkGroups(Roadmap& roadmap, const std::vector<PositionPoint>& position_points,
                  const std::vector<int>& key_frames, const FreeSpace& free_space,
                  const SweptSphere& sphere, const LinkParams& params, int seed,
                  const JobContext& job) {
    std::set<int> given_up;  // groups that could not be joined, by their smallest key frame
    std::uint64_t stream = 1000;
    while (true) {
        findGroups(roadmap, position_points.size(), key_frames);
        // The smallest part first: most of them are single points in narrow spaces.
        std::vector<std::pair<int, int>> sizes(roadmap.group_count);
        std::vector<int> smallest(sizes.size(), -1);
        for (const int key : key_frames) {
            const std::size_t g = roadmap.group[key];
            sizes[g].first += 1;
            sizes[g].second = static_cast<int>(g);
            if (smallest[g] < 0 || key < smallest[g]) smallest[g] = key;
        }
        std::sort(sizes.begin(), sizes.end());
        bool joined = false;
        for (const auto& [_, group] : sizes) {
            const int name = smallest[group];
            if (given_up.contains(name)) continue;
            const auto pairs = closestEnds(roadmap, position_points, key_frames, group);
            for (const Ends& pair : pairs) {
                if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
                const PositionPoint& a = position_points[pair.a];
                const PositionPoint& b = position_points[pair.b];
                // Grow the tree from the point of the smaller part: it is easier to find a path out
                // of a narrow space than into it.
                RrtStarProblem problem;
                problem.start = a.pose.position;
                problem.goal = b.pose.position;
                problem.is_cancelled = [&] { return job.cancelled(); };
                problem.max_iterations = params.link_iterations;
                auto sampler =
                    std::make_shared<ChainSampler>(free_space, sphere, a.component, problem.start,
                                                   problem.goal, params.sample_sigma_m);
                problem.sample = [sampler](Random& random) { return (*sampler)(random); };
                problem.is_free = [&](const Eigen::Vector3d& p) { return sphere.fits(p); };
                problem.is_move_free = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
                    return sphere.segment(p, q).free;
                };
                RrtStarResult way =
                    rrtStar(problem, Random(static_cast<std::uint64_t>(seed), ++stream));
                const int spent = static_cast<int>(way.samples.size());
                addSamples(roadmap, way, pair, problem.start);
                if (!way.found) {
                    roadmap.steps.add({StepKind::LinkFailed, pair.a, pair.b, spent});
                    continue;
                }
                roadmap.steps.add({StepKind::LinkFound, pair.a, pair.b,
                                   static_cast<std::int32_t>(roadmap.edges.size())});
                RoadmapEdge edge{pair.a, pair.b, {}, 0.0, true, true};
                edge.via = shortened(way.corners, problem.start, problem.goal, sphere);
                edge.length_m = wayLength(edge.via, problem.start, problem.goal);
                roadmap.edges.push_back(std::move(edge));
                // The joined part has new pairs of ends, so both halves may be tried again.
                given_up.erase(name);
                given_up.erase(smallest[roadmap.group[pair.b]]);
                joined = true;
                break;
            }
            if (joined) break;
            given_up.insert(name);
        }
        if (!joined) return {};
    }
}

}  // namespace dollytrack::planning
