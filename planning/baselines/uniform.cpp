#include "planning/baselines/uniform.h"

#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {
constexpr double kSteepestUniform = 30.0 * std::numbers::pi / 180.0;
}

Result<PlannedMotion> planUniform(const MappedScene& scene, const PlanParams& params, int seed,
                                  const JobContext& job) {
    PlannedMotion motion;
    motion.trajectory.frame_interval_s = 1.0 / params.timing.frame_rate;
    const std::vector<int> shares = shareByRoom(scene, frameBudget(params), 1);
    for (std::size_t room = 0; room < shares.size(); ++room) {
        Random random(static_cast<std::uint64_t>(seed), room);
        for (int i = 0; i < shares[room]; ++i) {
            if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
            TrajectoryFrame frame;
            const auto count = motion.trajectory.frames.size();
            frame.time_s = static_cast<double>(count) * motion.trajectory.frame_interval_s;
            frame.path = static_cast<int>(count);  // no motion between frames
            frame.component = static_cast<int>(room);
            const Eigen::Vector3d place = randomPlace(scene, frame.component, random);
            const double yaw = random.uniform(0.0, 2.0 * std::numbers::pi);
            const double pitch = random.uniform(-kSteepestUniform, kSteepestUniform);
            frame.target_in_world =
                place + Eigen::Vector3d(std::cos(yaw) * std::cos(pitch),
                                        std::sin(yaw) * std::cos(pitch), std::sin(pitch));
            frame.pose = lookAt(place, frame.target_in_world);
            motion.trajectory.frames.push_back(frame);
        }
    }
    return motion;
}

}  // namespace dollytrack::planning
