// RRT* between pairs of positions in one octree: ours and OMPL's, with the same collision checks on
// the same map. DOLLYTRACK_BENCH_SCENE names a scene; else the apartment.

#include "engine/core/log.h"
#include "engine/core/random.h"
#include "engine/io/import/scene_import.h"
#include "planning/collision/shortcut.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/linking/rrt_star.h"

#include <benchmark/benchmark.h>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <optional>

namespace dollytrack::planning {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr int kPairs = 24;
constexpr double kPatience_s = 2.0;

std::size_t anyOf(Random& random, std::size_t count) {
    return std::min(count - 1,
                    static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
}

struct World {
    Scene scene;
    RayCaster rays;
    FreeSpace space;
    SweptSphere sphere;
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;

    explicit World(Scene made)
        : scene(std::move(made)),
          rays(scene),
          space(std::move(*FreeSpace::build(scene, rays, {}, {}))),
          sphere(rays, space, CameraParams{}.camera_radius_m) {
        // Positions in the largest room that do not see each other: a straight move would need no
        // search.
        const auto& cells = space.cells(0);
        Random random(7);
        const auto place = [&] {
            while (true) {
                const Eigen::Vector3d at = cells[anyOf(random, cells.size())].cast<double>();
                if (sphere.fits(at)) return at;
            }
        };
        while (pairs.size() < kPairs) {
            const Eigen::Vector3d a = place();
            const Eigen::Vector3d b = place();
            if ((a - b).norm() > 2.0 && !sphere.segment(a, b).free) pairs.emplace_back(a, b);
        }
    }
};

World* world() {
    static const auto made = []() -> std::unique_ptr<World> {
        log::setLevel(log::Level::Error);
        ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
        const char* path = std::getenv("DOLLYTRACK_BENCH_SCENE");
        Result<Scene> loaded = importScene(path ? path : DOLLYTRACK_APARTMENT);
        return loaded ? std::make_unique<World>(std::move(*loaded)) : nullptr;
    }();
    return made.get();
}

struct Way {
    double first_s = kPatience_s;
    double total_s = 0.0;
    std::optional<double> length_m;
};

/// Runs until it ends by itself, or for `budget_s` when that is given.
Way ours(const World& in, std::size_t pair, std::optional<double> budget_s) {
    RrtStarProblem problem;
    std::tie(problem.start, problem.goal) = in.pairs[pair];
    const auto& cells = in.space.cells(0);
    problem.sample = [&](Random& random) -> Eigen::Vector3d {
        return cells[anyOf(random, cells.size())].cast<double>();
    };
    problem.is_free = [&](const Eigen::Vector3d& at) { return in.sphere.fits(at); };
    problem.is_move_free = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return in.sphere.segment(a, b).free;
    };
    const auto begin = Clock::now();
    Way way;
    problem.on_shorter = [&](double length) {
        if (!way.length_m) way.first_s = Seconds(Clock::now() - begin).count();
        way.length_m = length;
    };
    problem.max_iterations = 20000;
    if (budget_s) {
        problem.max_iterations = problem.improve_at_least = std::numeric_limits<int>::max();
        problem.is_cancelled = [&, end = begin + Seconds(*budget_s)] {
            return Clock::now() >= end;
        };
    }
    const RrtStarResult found = rrtStar(problem, Random(1));
    if (found.found) {
        // The same shortening as for links.
        const auto corners = shortened(found.corners, problem.start, problem.goal, in.sphere);
        way.length_m = wayLength(corners, problem.start, problem.goal);
    }
    way.total_s = Seconds(Clock::now() - begin).count();
    return way;
}

Eigen::Vector3d placeOf(const ob::State* state) {
    const double* v = state->as<ob::RealVectorStateSpace::StateType>()->values;
    return {v[0], v[1], v[2]};
}

class ProvenMoves : public ob::MotionValidator {
  public:
    ProvenMoves(const ob::SpaceInformationPtr& space, const SweptSphere& sphere)
        : ob::MotionValidator(space), sphere_(sphere) {}
    bool checkMotion(const ob::State* a, const ob::State* b) const override {
        return sphere_.segment(placeOf(a), placeOf(b)).free;
    }
    bool checkMotion(const ob::State* a, const ob::State* b,
                     std::pair<ob::State*, double>& last) const override {
        last.second = 0.0;
        return checkMotion(a, b);
    }

  private:
    const SweptSphere& sphere_;
};

/// Runs until the first path is found, or for `budget_s` when that is given.
Way theirs(const World& in, std::size_t pair, std::optional<double> budget_s) {
    const auto space = std::make_shared<ob::RealVectorStateSpace>(3);
    ob::RealVectorBounds bounds(3);
    for (unsigned k = 0; k < 3; ++k) {
        bounds.setLow(k, in.space.rooms()[0].box.min()[k]);
        bounds.setHigh(k, in.space.rooms()[0].box.max()[k]);
    }
    space->setBounds(bounds);
    og::SimpleSetup setup(space);
    setup.setStateValidityChecker(
        [&](const ob::State* state) { return in.sphere.fits(placeOf(state)); });
    setup.getSpaceInformation()->setMotionValidator(
        std::make_shared<ProvenMoves>(setup.getSpaceInformation(), in.sphere));
    ob::ScopedState<> start(space);
    ob::ScopedState<> goal(space);
    for (unsigned k = 0; k < 3; ++k) {
        start[k] = in.pairs[pair].first[k];
        goal[k] = in.pairs[pair].second[k];
    }
    setup.setStartAndGoalStates(start, goal);
    auto objective =
        std::make_shared<ob::PathLengthOptimizationObjective>(setup.getSpaceInformation());
    // Without a budget any length satisfies the objective (only the first path counts); with one,
    // none does.
    objective->setCostThreshold(ob::Cost(budget_s ? 0.0 : 1e9));
    setup.setOptimizationObjective(objective);
    setup.setPlanner(std::make_shared<og::RRTstar>(setup.getSpaceInformation()));
    setup.setup();
    const auto begin = Clock::now();
    const ob::PlannerStatus status = setup.solve(budget_s.value_or(kPatience_s));
    Way way;
    way.total_s = Seconds(Clock::now() - begin).count();
    if (status == ob::PlannerStatus::EXACT_SOLUTION) {
        way.first_s = way.total_s;
        way.length_m = setup.getSolutionPath().length();
    }
    return way;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::nth_element(values,
                             values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

void firstWay(benchmark::State& state, bool ompl) {
    const World* in = world();
    if (in == nullptr) return state.SkipWithError("the scene cannot be loaded");
    std::vector<double> first_ms;
    double found = 0.0;
    for (auto _ : state) {
        double sum_s = 0.0;
        for (std::size_t pair = 0; pair < kPairs; ++pair) {
            const Way way = ompl ? theirs(*in, pair, {}) : ours(*in, pair, {});
            sum_s += way.first_s;
            found += way.length_m ? 1 : 0;
            first_ms.push_back(1e3 * way.first_s);
        }
        state.SetIterationTime(sum_s / kPairs);
    }
    state.counters["median_ms"] = median(first_ms);
    state.counters["found"] = found / static_cast<double>(first_ms.size());
}
BENCHMARK_CAPTURE(firstWay, ours, false)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(firstWay, ompl, true)->UseManualTime()->Unit(benchmark::kMillisecond);

/// Both get the same time for each pair, given in milliseconds; 0 stands for the time that ours
/// takes until it ends by itself.
void lengthAtEqualTime(benchmark::State& state) {
    const World* in = world();
    if (in == nullptr) return state.SkipWithError("the scene cannot be loaded");
    std::vector<double> ratios;
    std::vector<double> times_ms;
    double missed = 0.0;
    double longer = 0.0;  // more than 1 % longer than OMPL's
    for (auto _ : state) {
        for (std::size_t pair = 0; pair < kPairs; ++pair) {
            std::optional<double> budget_s;
            if (state.range(0) > 0) budget_s = 1e-3 * static_cast<double>(state.range(0));
            const Way mine = ours(*in, pair, budget_s);
            const Way other = theirs(*in, pair, mine.total_s);
            times_ms.push_back(1e3 * mine.total_s);
            missed += other.length_m ? 0 : 1;
            if (!mine.length_m || !other.length_m) continue;
            ratios.push_back(*mine.length_m / *other.length_m);
            longer += ratios.back() > 1.01 ? 1 : 0;
        }
    }
    const auto all = static_cast<double>(times_ms.size());
    state.counters["median_ms"] = median(times_ms);
    state.counters["ours_to_ompl"] = median(ratios);
    state.counters["ours_longer"] = longer / all;
    state.counters["ompl_missed"] = missed / all;
}
BENCHMARK(lengthAtEqualTime)
    ->ArgName("ms")
    ->Arg(0)
    ->Arg(5)
    ->Arg(20)
    ->Arg(100)
    ->Iterations(2)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dollytrack::planning
