#include "app/editor/timeline/key_placement.h"

#include "planning/motions/key_motion.h"
#include "planning/timing/motion_limits.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::editor {
namespace {

// Keys of nearly the same view are at least this far apart, s, so that both can be seen and
// dragged.
constexpr double kLeastStep_s = 0.5;
// The window waits while the time of a new key is computed: more frames than this are estimated.
constexpr std::size_t kMostFrames = 2000;

/// The time on a whole frame, without the rounding error of the multiplication.
double onFrame(double time_s, double interval_s) {
    return std::round(1e6 * std::round(time_s / interval_s) * interval_s) / 1e6;
}

double timeAfterLast(const std::vector<MotionKey>& keys, const Pose& view,
                     const planning::TimingParams& timing) {
    const double interval_s = 1.0 / timing.frame_rate;
    // The key before the last one tells the direction of the motion; earlier ones do not matter.
    std::vector<MotionKey> end(keys.end() - std::min<std::ptrdiff_t>(std::ssize(keys), 2),
                               keys.end());
    const double last_s = end.back().time_s;
    const Pose last = end.back().pose;
    const double longest_s = 0.5 * kMostFrames * interval_s;
    end.front().time_s = std::max(end.front().time_s, last_s - longest_s);
    end.push_back({last_s + interval_s, view});
    const planning::MotionLimits limits = planning::motionLimits(timing);
    const auto times = planning::keyTimes(end, limits, interval_s, {}, kMostFrames);
    // A long move is at the largest speed or turn rate nearly all the time.
    const double later_s =
        times ? (*times)[end.size() - 1] - (*times)[end.size() - 2]
              : std::max((view.position - last.position).norm() / limits.speed_mps,
                         angleBetween(last.rotation, view.rotation) / limits.turn_rps);
    return onFrame(last_s + std::max(later_s, kLeastStep_s), interval_s);
}

/// The middle of two times, rounded to a whole frame if one lies between them.
double halfway(double before_s, double after_s, double interval_s) {
    const double exact = 0.5 * (before_s + after_s);
    const double wanted = onFrame(exact, interval_s);
    return wanted > before_s && wanted < after_s ? wanted : exact;
}

/// Whether the plan passes the keys, and has a frame at the playhead.
bool isPassed(const std::vector<MotionKey>& keys, const Plan* plan, int playhead) {
    return plan != nullptr && plan->passed_keys.size() == keys.size() && playhead >= 0 &&
           static_cast<std::size_t>(playhead) < plan->trajectory.frames.size();
}

/// Converts a time of the trajectory to the time scale of the keys. They differ where the motion
/// limits make the camera pass keys later than their times.
double keyTimeAt(double time_s, const MotionKey& before, const PassedKey& before_passed,
                 const MotionKey& after, const PassedKey& after_passed, double interval_s) {
    const double share = (time_s - before_passed.time_s) /
                         std::max(after_passed.time_s - before_passed.time_s, interval_s);
    const double exact = before.time_s + share * (after.time_s - before.time_s);
    const double wanted = onFrame(exact, interval_s);
    return wanted > before.time_s && wanted < after.time_s ? wanted : exact;
}

}  // namespace

double timeOfNewKey(const std::vector<MotionKey>& keys, const Plan* plan, int playhead, int after,
                    const Pose& view, const planning::TimingParams& timing) {
    if (keys.empty()) return 0.0;
    const double interval_s = 1.0 / timing.frame_rate;
    const bool is_passed = isPassed(keys, plan, playhead);
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        if (after >= 0 && static_cast<std::size_t>(after) != i) continue;
        if (is_passed && playhead > plan->passed_keys[i].frame &&
            playhead < plan->passed_keys[i + 1].frame) {
            const double time_s =
                plan->trajectory.frames[static_cast<std::size_t>(playhead)].time_s;
            return keyTimeAt(time_s, keys[i], plan->passed_keys[i], keys[i + 1],
                             plan->passed_keys[i + 1], interval_s);
        }
        if (after >= 0 || (is_passed && playhead == plan->passed_keys[i].frame)) {
            return halfway(keys[i].time_s, keys[i + 1].time_s, interval_s);
        }
    }
    return timeAfterLast(keys, view, timing);
}

std::optional<std::size_t> keyAtPlayhead(const std::vector<MotionKey>& keys, const Plan* plan,
                                         int playhead) {
    if (!isPassed(keys, plan, playhead)) return std::nullopt;
    const auto at = std::ranges::find(plan->passed_keys, playhead, &PassedKey::frame);
    if (at == plan->passed_keys.end()) return std::nullopt;
    return static_cast<std::size_t>(at - plan->passed_keys.begin());
}

}  // namespace dollytrack::editor
