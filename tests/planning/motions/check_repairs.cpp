// Breaks trajectories in several ways, repairs them and measures the result with planner_metrics.
// check_repairs SCENE... Exit code 1 if a repaired trajectory collides.

#include "engine/core/log.h"
#include "engine/io/import/scene_import.h"
#include "engine/plan/motion_metrics.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/baselines/planner.h"
#include "planning/collision/path_clearance.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/repair_motion.h"
#include "planning/timing/motion_limits.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace dollytrack::planning {
namespace {

using Clock = std::chrono::steady_clock;

/// Sums of three sinusoids of 0.1 to 0.5 Hz on each axis, at most `amplitude_m`.
Trajectory shaken(Trajectory trajectory, double amplitude_m, int seed) {
    Random random(static_cast<std::uint64_t>(seed), 77);
    Eigen::Matrix3d phases;
    Eigen::Matrix3d rates;
    for (int i = 0; i < 9; ++i) {
        phases(i % 3, i / 3) = random.uniform(0.0, 2.0 * std::numbers::pi);
        rates(i % 3, i / 3) = 2.0 * std::numbers::pi * random.uniform(0.1, 0.5);
    }
    for (TrajectoryFrame& frame : trajectory.frames) {
        for (int axis = 0; axis < 3; ++axis) {
            double wave = 0.0;
            for (int k = 0; k < 3; ++k)
                wave += std::sin(phases(axis, k) + rates(axis, k) * frame.time_s) / 3.0;
            frame.pose.position[axis] += amplitude_m * wave;
        }
    }
    return trajectory;
}

/// A straight line at constant speed between two random free positions, looking along it.
Trajectory straightLine(const MappedScene& scene, double speed_mps, double interval_s, int seed) {
    Random random(static_cast<std::uint64_t>(seed), 78);
    Trajectory trajectory;
    trajectory.frame_interval_s = interval_s;
    Eigen::Vector3d from, to;
    for (int i = 0; i < 50; ++i) {
        const auto rooms = static_cast<std::uint32_t>(scene.free_space->rooms().size());
        from = randomPlace(scene, 0, random);
        to = randomPlace(scene, seed % 5 == 4 ? static_cast<int>(random.below(rooms)) : 0, random);
        if ((to - from).norm() > 2.0 && !scene.sphere->segment(from, to).free) break;
    }
    const double parts = std::ceil((to - from).norm() / (speed_mps * interval_s));
    for (double k = 0.0; k <= parts; k += 1.0) {
        TrajectoryFrame frame;
        frame.time_s = k * interval_s;
        frame.pose = lookAt(from + k / parts * (to - from), to + (to - from));
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

struct Tally {
    int done = 0, colliding = 0, over = 0, far = 0, mostly_free = 0;
};

/// Share of the given length that is free.
double freeShare(const MappedScene& scene, const Trajectory& given) {
    double all = 0.0, free = 0.0;
    for (std::size_t i = 0; i + 1 < given.frames.size(); ++i) {
        if (given.frames[i].path != given.frames[i + 1].path) continue;
        const Eigen::Vector3d& a = given.frames[i].pose.position;
        const Eigen::Vector3d& b = given.frames[i + 1].pose.position;
        all += (b - a).norm();
        if (scene.sphere->segment(a, b).free) free += (b - a).norm();
    }
    return all > 0.0 ? free / all : 1.0;
}

void check(const MappedScene& scene, const PlanParams& params, const Trajectory& given,
           const std::string& name, Tally& tally) {
    const auto start = Clock::now();
    const auto repaired = repairMotion(scene, params, given, {});
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    ++tally.done;
    if (!repaired) {
        std::printf("%-44s %s\n", name.c_str(), describe(repaired.error()).c_str());
        ++tally.colliding;
        return;
    }
    const MotionChange& change = repaired->change;
    const double radius = scene.sphere->radius();
    int hits = 0;
    const auto& frames = repaired->trajectory.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Eigen::Vector3d& here = frames[i].pose.position;
        const bool moves = i + 1 < frames.size() && frames[i].path == frames[i + 1].path;
        const Eigen::Vector3d& next = moves ? frames[i + 1].pose.position : here;
        const bool free = smallestClearance(*scene.rays, {here, next}, radius, {}) >= radius &&
                          scene.free_space->stateAt(here) == CellState::Free;
        hits += free ? 0 : 1;
    }
    const MotionMetrics motion = measureMotion(repaired->trajectory);
    const MotionLimits limits = motionLimits(params.timing);
    const bool over = motion.speed_mps.max > 1.021 * limits.speed_mps ||
                      motion.turn_dps.max > 1.021 * limits.turn_rps * 180.0 / std::numbers::pi;
    const double share = freeShare(scene, given);
    const auto again = repairMotion(scene, params, repaired->trajectory, {});
    const bool stable = again && again->change.frames_in_collision +
                                         again->change.moves_in_collision +
                                         again->change.moves_over_limits ==
                                     0;
    std::printf(
        "%-44s free %3.0f %% frames %4zu hit %3d moves %3d over %4d | hits %d over %d "
        "shift mean %.3f max %.3f moved %3d cut %d time %+.1f s accel %.2f (given %.2f) "
        "again %d | %.2f s\n",
        name.c_str(), 100.0 * share, given.frames.size(), change.frames_in_collision,
        change.moves_in_collision, change.moves_over_limits, hits, over ? 1 : 0,
        change.mean_shift_m, change.largest_shift_m, change.frames_moved, change.paths_cut,
        change.time_added_s, motion.acceleration_mps2.max,
        measureMotion(given).acceleration_mps2.max, stable ? 1 : 0, seconds);
    tally.colliding += hits > 0 ? 1 : 0;
    tally.over += over ? 1 : 0;
    if (share >= 0.9) {
        ++tally.mostly_free;
        tally.far += change.mean_shift_m > 0.1 ? 1 : 0;
    }
}

bool checkScene(const std::string& path, Tally& tally) {
    Result<Scene> loaded = importScene(path);
    if (!loaded) {
        std::printf("%s: %s\n", path.c_str(), describe(loaded.error()).c_str());
        return false;
    }
    PlanParams params;
    const auto scene = mapScene(std::make_shared<const Scene>(std::move(*loaded)), {}, params, {});
    if (!scene) return false;
    const std::string name = scene->scene->name;
    int seed = 1;
    const auto planned = [&](const char* planner) {
        return choosePlanners({planner}).value().front()->plan(*scene, params, seed++, {});
    };
    for (const char* planner : {"random-keys-hard", "two-body", "density-walk"}) {
        const auto motion = planned(planner);
        if (motion) check(*scene, params, motion->trajectory, name + " " + planner, tally);
    }
    PlanParams short_params = params;
    short_params.timing.max_frames = 300;
    const auto motion =
        choosePlanners({"dollytrack"}).value().front()->plan(*scene, short_params, 1, {});
    if (motion) {
        check(*scene, params, motion->trajectory, name + " dollytrack", tally);
        for (const double amplitude : {0.05, 0.15, 0.3}) {
            check(*scene, params, shaken(motion->trajectory, amplitude, seed++),
                  name + " shaken " + std::to_string(amplitude).substr(0, 4), tally);
        }
    }
    for (int k = 0; k < 5; ++k) {
        check(*scene, params, straightLine(*scene, 0.4, k == 3 ? 2.5 : 0.1, seed++),
              name + (k == 3 ? " line of keys" : " line"), tally);
    }
    return true;
}

}  // namespace
}  // namespace dollytrack::planning

int main(int argc, char** argv) {
    dollytrack::log::setLevel(dollytrack::log::Level::Error);
    dollytrack::planning::Tally tally;
    bool read = argc > 1;
    for (int i = 1; i < argc; ++i) read = dollytrack::planning::checkScene(argv[i], tally) && read;
    std::printf(
        "%d trajectories, %d collide, %d over the limits; of %d at least 90 %% free, %d are "
        "shifted by more than 10 cm\n",
        tally.done, tally.colliding, tally.over, tally.mostly_free, tally.far);
    return read && tally.done > 0 && tally.colliding + tally.over == 0 ? 0 : 1;
}
