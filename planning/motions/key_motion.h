#pragma once

#include "engine/document/given_motion.h"
#include "engine/plan/passed_key.h"
#include "planning/motions/repair_motion.h"
#include "planning/timing/motion_limits.h"

#include <cstddef>
#include <span>
#include <vector>

namespace dollytrack::planning {

struct TimingParams;

/// The times at which a camera within the limits can be at the keys, s: the given ones, to whole
/// frames after the first, or the earliest possible ones. Obstacles are left aside. Errors:
/// BadInput if the motion would take more than `most_frames`; Cancelled.
Result<std::vector<double>> keyTimes(std::span<const MotionKey> keys, const MotionLimits& limits,
                                     double interval_s, const JobContext& job,
                                     std::size_t most_frames = kMostMotionFrames);

/// Whether a camera passes a key late; shorter delays come from rounding to frames.
[[nodiscard]] constexpr bool isLate(double delay_s, double frame_interval_s) {
    return delay_s > 0.75 * frame_interval_s;
}

struct KeyMotion {
    Trajectory trajectory;
    std::vector<PassedKey> passed;  // one for each key
};

/// The smooth motion through the keys (see KeyCurve) at the frame rate. The camera is at a key in
/// the frame nearest to its time, or as soon after it as the motion limits and a way around
/// obstacles allow; later keys are in time again where their times leave room for that. After a way
/// around obstacles it may be at a key some tenths of a second early. If a key is in collision, not
/// reached, or its time is not kept, its note says so. Where no motion near the keys is free, the
/// trajectory collides, and each key in collision has a note that says so. Errors: those of
/// keyTimes(); BadInput if the way around obstacles would take more than kMostMotionFrames.
Result<KeyMotion> moveThroughKeys(const MappedScene& scene, const TimingParams& timing,
                                  const std::vector<MotionKey>& keys, const JobContext& job);

/// The keys at the times at which the camera reaches them. Where one frame passes several keys,
/// they follow each other at the frame interval, because the times of keys must rise.
std::vector<MotionKey> withReachedTimes(std::vector<MotionKey> keys,
                                        std::span<const PassedKey> passed, double interval_s);

/// The keys with times at which the camera reaches them: the given ones, or later ones. Plans the
/// motion until no key is late, at most ten times, because later times change the motion between
/// the keys. Errors: those of moveThroughKeys().
Result<std::vector<MotionKey>> withReachableTimes(const MappedScene& scene,
                                                  const TimingParams& timing,
                                                  std::vector<MotionKey> keys,
                                                  const JobContext& job);

/// Appends keys along a trajectory, a second apart. The first of them is as much later than the
/// last given key as the motion limits need. Errors: those of keyTimes().
Result<std::vector<MotionKey>> withKeysAlong(std::vector<MotionKey> keys,
                                             const Trajectory& trajectory,
                                             const TimingParams& timing, const JobContext& job);

}  // namespace dollytrack::planning
