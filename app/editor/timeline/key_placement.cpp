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

/// The time of the keys at a time of the trajectory, which passes them later where the limits ask.
double keyTimeAt(double time_s, const MotionKey& before, const PassedKey& before_passed,
                 const MotionKey& after, const PassedKey& after_passed, double interval_s) {
    const double share = (time_s - before_passed.time_s) /
                         std::max(after_passed.time_s - before_passed.time_s, interval_s);
    const double exact = before.time_s + share * (after.time_s - before.time_s);
    const double wanted = onFrame(exact, interval_s);
    return wanted > before.time_s && wanted < after.time_s ? wanted : exact;
}

}  // namespace

KeyPlacement placeKey(const std::vector<MotionKey>& keys, const Plan* plan, int playhead,
                      int selected, const Pose& view, const planning::TimingParams& timing) {
    if (keys.empty()) return {};
    if (selected >= 0 && static_cast<std::size_t>(selected) < keys.size()) {
        return {static_cast<std::size_t>(selected), 0.0};
    }
    const bool is_passed = plan != nullptr && plan->passed_keys.size() == keys.size() &&
                           playhead >= 0 &&
                           static_cast<std::size_t>(playhead) < plan->trajectory.frames.size();
    for (std::size_t i = 0; is_passed && i + 1 < keys.size(); ++i) {
        const PassedKey& before = plan->passed_keys[i];
        const PassedKey& after = plan->passed_keys[i + 1];
        if (playhead == before.frame) return {i, 0.0};
        if (playhead <= before.frame || playhead >= after.frame) continue;
        const double time_s = plan->trajectory.frames[static_cast<std::size_t>(playhead)].time_s;
        return {std::nullopt,
                keyTimeAt(time_s, keys[i], before, keys[i + 1], after, 1.0 / timing.frame_rate)};
    }
    return {std::nullopt, timeAfterLast(keys, view, timing)};
}

}  // namespace dollytrack::editor
