#include "engine/document/given_motion.h"

#include "engine/document/json_reader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace dollytrack {
namespace {

constexpr double kFarthest_m = 1e6;
constexpr double kUnitLength = 1e-6;  // largest deviation of a quaternion's length from 1

/// What is wrong with a frame or key; empty if nothing is. Comparisons are false for NaN.
template <class Frame>
std::string faultOf(const Frame& frame, const Frame* before) {
    if (!(frame.time_s >= 0.0 && frame.time_s <= kLastMotionTime_s)) {
        return fmt::format("The time must be from 0 to {:g} s.", kLastMotionTime_s);
    }
    if (before && !(frame.time_s > before->time_s)) {
        return "The time is not later than the previous one.";
    }
    if (!frame.pose.position.allFinite() ||
        !(frame.pose.position.cwiseAbs().maxCoeff() <= kFarthest_m)) {
        return "The position is not a number or more than 1000 km away; check its unit.";
    }
    if (!(std::abs(frame.pose.rotation.norm() - 1.0) <= kUnitLength)) {
        return "A quaternion must have length 1.";
    }
    return {};
}

/// The first faulty frame or key of a list.
template <class Frame>
std::optional<MotionFault> faultIn(const std::vector<Frame>& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
        std::string text = faultOf(frames[i], i > 0 ? &frames[i - 1] : nullptr);
        if (!text.empty()) return MotionFault{i, std::move(text)};
    }
    return {};
}

double anyNumber(const JsonReader& from) {
    using Limits = std::numeric_limits<double>;
    return from.number(Limits::lowest(), Limits::max());
}

/// Time and pose: the first eight numbers of a list.
MotionKey readTimedPose(const JsonReader& from) {
    const auto number = [&](std::size_t i) { return anyNumber(from.at(i)); };
    MotionKey key;
    key.time_s = number(0);
    key.pose.position = {number(1), number(2), number(3)};
    key.pose.rotation = Eigen::Quaterniond(number(7), number(4), number(5), number(6));
    return key;
}

MotionFrame readMotionFrame(const JsonReader& from) {
    constexpr int kLargestPath = 1'000'000;
    const std::size_t size = from.size();
    if (size != 8 && size != 9) {
        from.refuse(
            "A frame is a list: time, x, y, z, qx, qy, qz, qw, and the number of its path.");
        return {};
    }
    const MotionKey timed = readTimedPose(from);
    return {timed.time_s, timed.pose, size == 9 ? from.at(8).integer(0, kLargestPath) : 0};
}

MotionKey readMotionKey(const JsonReader& from) {
    if (from.size() == 8) return readTimedPose(from);
    from.refuse("A key is a list: time, x, y, z, qx, qy, qz, qw.");
    return {};
}

nlohmann::json timedPoseJson(double time_s, const Pose& pose) {
    const Eigen::Vector3d& p = pose.position;
    const Eigen::Quaterniond& q = pose.rotation;
    return nlohmann::json::array({time_s, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()});
}

/// Reads the list of frames or keys.
template <class Frame, class Read>
std::vector<Frame> readMotionList(const JsonReader& list, const Read& read) {
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < list.size() && list.good(); ++i) frames.push_back(read(list.at(i)));
    return frames;
}

}  // namespace

double GivenMotion::duration_s() const {
    if (!keys.empty()) return keys.back().time_s - keys.front().time_s;
    return frames.empty() ? 0.0 : frames.back().time_s - frames.front().time_s;
}

GivenMotion GivenMotion::between(double from_s, double to_s) const {
    const auto trimmed = [&](auto items) {
        std::erase_if(items,
                      [&](const auto& item) { return item.time_s < from_s || item.time_s > to_s; });
        const double begin_s = items.empty() ? 0.0 : items.front().time_s;
        for (auto& item : items) item.time_s -= begin_s;
        return items;
    };
    return {name, frame_interval_s, trimmed(frames), trimmed(keys)};
}

std::optional<MotionFault> findFault(const GivenMotion& motion) {
    const std::size_t count = motion.frames.size();
    if (!motion.keys.empty()) {
        if (count > 0) return MotionFault{{}, "A camera motion has either frames or keys."};
        if (motion.keys.size() <= kMostMotionKeys) return faultIn(motion.keys);
        return MotionFault{{},
                           fmt::format("The camera motion has {} keys, but at most {} are "
                                       "possible; leave out some.",
                                       motion.keys.size(), kMostMotionKeys)};
    }
    if (count == 0) return MotionFault{{}, "A camera motion needs at least one frame or key."};
    if (count > kMostMotionFrames) {
        return MotionFault{{},
                           fmt::format("The camera motion has {} frames, but at most {} are "
                                       "possible; leave out some.",
                                       count, kMostMotionFrames)};
    }
    if (!(motion.frame_interval_s > 0.0 && motion.frame_interval_s <= kLastMotionTime_s)) {
        return MotionFault{{}, "The frame interval must be above 0 s."};
    }
    return faultIn(motion.frames);
}

GivenMotion givenMotion(std::string name, const Trajectory& trajectory) {
    GivenMotion motion{std::move(name), trajectory.frame_interval_s, {}};
    for (const TrajectoryFrame& frame : trajectory.frames) {
        motion.frames.push_back(
            {frame.time_s - trajectory.frames.front().time_s, frame.pose, frame.path});
    }
    return motion;
}

Trajectory trajectoryOf(const GivenMotion& motion) {
    Trajectory trajectory{motion.frame_interval_s, {}};
    int path = 0;
    for (std::size_t i = 0; i < motion.frames.size(); ++i) {
        const MotionFrame& given = motion.frames[i];
        if (i > 0 && given.path != motion.frames[i - 1].path) ++path;
        TrajectoryFrame frame;
        frame.time_s = given.time_s;
        frame.pose = given.pose;
        frame.target_in_world = given.pose.position + given.pose.forward();
        frame.path = path;
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

nlohmann::json motionJson(const GivenMotion& motion) {
    if (!motion.keys.empty()) {
        nlohmann::json keys = nlohmann::json::array();
        for (const MotionKey& key : motion.keys) {
            keys.push_back(timedPoseJson(key.time_s, key.pose));
        }
        return {{"name", motion.name}, {"keys", std::move(keys)}};
    }
    nlohmann::json frames = nlohmann::json::array();
    for (const MotionFrame& frame : motion.frames) {
        frames.push_back(timedPoseJson(frame.time_s, frame.pose));
        frames.back().push_back(frame.path);
    }
    return {{"name", motion.name},
            {"frame_interval_s", motion.frame_interval_s},
            {"frames", std::move(frames)}};
}

GivenMotion readMotion(const JsonReader& from) {
    GivenMotion motion;
    const JsonReader keys = from.at("keys");
    const JsonReader frames = keys.absent() ? from.at("frames") : keys;
    if (keys.absent()) {
        motion.frames = readMotionList<MotionFrame>(frames, readMotionFrame);
    } else if (!from.at("frames").absent()) {
        keys.refuse("A camera motion has either frames or keys.");
    } else {
        motion.keys = readMotionList<MotionKey>(keys, readMotionKey);
    }
    if (const JsonReader name = from.at("name"); !name.absent()) motion.name = name.text();
    if (const JsonReader interval = from.at("frame_interval_s"); !interval.absent()) {
        motion.frame_interval_s = anyNumber(interval);
    } else if (const auto step_s = medianStep_s(trajectoryOf(motion).frames)) {
        motion.frame_interval_s = *step_s;
    }
    if (!from.good()) return motion;
    if (const auto fault = findFault(motion)) {
        (fault->frame ? frames.at(*fault->frame) : frames).refuse(fault->text);
    }
    return motion;
}

}  // namespace dollytrack
