#include "planning/baselines/random_keys.h"

#include "planning/collision/shortcut.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/linking/rrt_star.h"
#include "planning/timing/motion_limits.h"
#include "planning/timing/turn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kSpeedFactor = 2.0;
constexpr double kSteepest = 30.0 * std::numbers::pi / 180.0;
constexpr double kLeastLeg = 0.5;  // m, between keys
constexpr int kKeyTries = 20;

/// Sinusoids with seeded phases: along each axis of the world, then yaw and pitch.
class Shake {
  public:
    explicit Shake(Random random) {
        for (double& phase : phases_) phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    }
    [[nodiscard]] Pose at(const Pose& pose, double time_s) const {
        constexpr double kMove = 0.06;                            // m
        constexpr double kTurn = 6.0 * std::numbers::pi / 180.0;  // rad
        constexpr std::array<double, 5> kHertz = {0.9, 1.1, 1.6, 0.7, 1.3};
        std::array<double, 5> wave{};
        for (std::size_t i = 0; i < wave.size(); ++i) {
            wave[i] = std::sin(2.0 * std::numbers::pi * kHertz[i] * time_s + phases_[i]);
        }
        const Eigen::Vector3d moved =
            pose.position + kMove * Eigen::Vector3d(wave[0], wave[1], wave[2]);
        const Eigen::Quaterniond turned =
            Eigen::AngleAxisd(kTurn * wave[3], Eigen::Vector3d::UnitZ()) * pose.rotation *
            Eigen::AngleAxisd(kTurn * wave[4], Eigen::Vector3d::UnitX());
        return {moved, turned.normalized()};
    }

  private:
    std::array<double, 5> phases_{};
};

struct Leg {
    std::vector<Eigen::Vector3d> points;  // start, corners, goal
    double length_m = 0.0;
    Eigen::Quaterniond from, to;
};

Eigen::Quaterniond randomHeading(Random& random) {
    const double yaw = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double pitch = random.uniform(-kSteepest, kSteepest);
    return lookAlong(
        {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)});
}

/// The position at arc length `arc` of the leg. Appends the corners passed since `before`.
Eigen::Vector3d along(const Leg& leg, double arc, double before,
                      std::vector<Eigen::Vector3d>& passed) {
    double begin = 0.0;
    for (std::size_t i = 1; i < leg.points.size(); ++i) {
        const double length = (leg.points[i] - leg.points[i - 1]).norm();
        if (i > 1 && begin > before && begin < arc) passed.push_back(leg.points[i - 1]);
        if (arc <= begin + length || i + 1 == leg.points.size()) {
            const double share = length > 0.0 ? std::clamp((arc - begin) / length, 0.0, 1.0) : 0.0;
            return leg.points[i - 1] + share * (leg.points[i] - leg.points[i - 1]);
        }
        begin += length;
    }
    return leg.points.back();
}

/// A path to another random key of the room; without points if none was found.
Leg nextLeg(const MappedScene& scene, const PlanParams& params, int room,
            const Eigen::Vector3d& start, const Eigen::Quaterniond& heading, Random& random,
            const JobContext& job) {
    const auto& cells = scene.sphere->cells(room);
    for (int attempt = 0; attempt < kKeyTries && !job.cancelled(); ++attempt) {
        const Eigen::Vector3d goal = randomPlace(scene, room, random);
        if ((goal - start).norm() < kLeastLeg) continue;
        RrtStarProblem problem;
        problem.start = start;
        problem.goal = goal;
        problem.sample = [&](Random& r) -> Eigen::Vector3d {
            return cells[r.below(static_cast<std::uint32_t>(cells.size()))].cast<double>();
        };
        problem.is_free = [&](const Eigen::Vector3d& p) { return scene.sphere->fits(p); };
        problem.is_move_free = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
            return scene.sphere->segment(a, b).free;
        };
        problem.is_cancelled = [&] { return job.cancelled(); };
        problem.max_iterations = params.linking.link_iterations;
        const std::uint64_t stream = random.next();
        const RrtStarResult found = rrtStar(problem, Random(stream, 1));
        if (!found.found) continue;
        Leg leg;
        leg.points = {start};
        const auto corners = shortened(found.corners, start, goal, *scene.sphere);
        leg.points.insert(leg.points.end(), corners.begin(), corners.end());
        leg.points.push_back(goal);
        leg.length_m = wayLength(corners, start, goal);
        leg.from = heading;
        leg.to = randomHeading(random);
        return leg;
    }
    return {};
}

void shake(const MappedScene& scene, int seed, PlannedMotion& motion) {
    const Shake bumps(Random(static_cast<std::uint64_t>(seed), 999));
    for (TrajectoryFrame& frame : motion.trajectory.frames) {
        const Pose shaken = bumps.at(frame.pose, frame.time_s);
        if (!scene.sphere->fits(shaken.position)) continue;
        frame.pose = shaken;
        frame.target_in_world = shaken.position + shaken.forward();
    }
}

Result<PlannedMotion> planKeys(const MappedScene& scene, const PlanParams& params, int seed,
                               const JobContext& job) {
    PlannedMotion motion;
    const double interval = 1.0 / params.timing.frame_rate;
    motion.trajectory.frame_interval_s = interval;
    auto& frames = motion.trajectory.frames;
    const double step = kSpeedFactor * motionLimits(params.timing).speed_mps * interval;
    const std::vector<int> shares = shareByRoom(scene, frameBudget(params), 20);
    for (std::size_t room = 0; room < shares.size(); ++room) {
        if (shares[room] == 0) continue;
        Random random(static_cast<std::uint64_t>(seed), room);
        const auto add = [&](const Eigen::Vector3d& place, const Eigen::Quaterniond& rotation) {
            TrajectoryFrame frame;
            frame.time_s = static_cast<double>(frames.size()) * interval;
            frame.pose = {place, rotation};
            frame.target_in_world = place + frame.pose.forward();
            frame.component = static_cast<int>(room);
            frame.path = static_cast<int>(room);
            frames.push_back(frame);
        };
        const std::size_t end = frames.size() + static_cast<std::size_t>(shares[room]);
        add(randomPlace(scene, static_cast<int>(room), random), randomHeading(random));
        while (frames.size() < end) {
            if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
            const Leg leg =
                nextLeg(scene, params, static_cast<int>(room), frames.back().pose.position,
                        frames.back().pose.rotation, random, job);
            if (leg.points.empty()) break;
            // Steps of equal length, so that each key is a frame.
            const int steps = std::max(1, static_cast<int>(std::ceil(leg.length_m / step)));
            const Turn turn(leg.from, leg.to);
            for (int i = 1; i <= steps && frames.size() < end; ++i) {
                const double before = leg.length_m * (i - 1) / steps;
                const double share = static_cast<double>(i) / steps;
                motion.between.resize(frames.size());
                const Eigen::Vector3d place =
                    along(leg, leg.length_m * share, before, motion.between.back());
                add(place, turn.at(share * turn.angle()));
            }
            job.report(static_cast<double>(frames.size()) / frameBudget(params));
        }
        motion.between.resize(frames.size());
    }
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    return motion;
}

}  // namespace

Result<PlannedMotion> planRandomKeysEasy(const MappedScene& scene, const PlanParams& params,
                                         int seed, const JobContext& job) {
    return planKeys(scene, params, seed, job);
}

Result<PlannedMotion> planRandomKeysHard(const MappedScene& scene, const PlanParams& params,
                                         int seed, const JobContext& job) {
    return planKeys(scene, params, seed, job).map([&](PlannedMotion&& motion) {
        // The unshaken corners are no longer on the path.
        motion.between.clear();
        shake(scene, seed, motion);
        return std::move(motion);
    });
}

}  // namespace dollytrack::planning
