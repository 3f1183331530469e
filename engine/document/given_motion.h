#pragma once

#include "engine/camera/trajectory.h"
#include "engine/math/pose.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack {

class JsonReader;

/// A frame of a given motion.
struct MotionFrame {
    double time_s = 0.0;
    Pose pose;     // world_from_camera; roll is possible
    int path = 0;  // changes where the camera jumps
    bool operator==(const MotionFrame&) const = default;
};

/// A key frame of a camera motion: where the camera is at a time.
struct MotionKey {
    double time_s = 0.0;
    Pose pose;  // world_from_camera; roll is possible
    bool operator==(const MotionKey&) const = default;
};

/// A camera motion that the user gives instead of having one planned. It has either frames or keys.
/// Frames are imported, repaired, or made from a template, and the plan takes them unchanged. Keys
/// are recorded one by one; planning makes the smooth, collision-free motion through them.
struct GivenMotion {
    std::string name;
    double frame_interval_s = 0.1;     // of the frames; keys have the frame rate of the plan
    std::vector<MotionFrame> frames;   // by rising time; at least one, or none with keys
    std::vector<MotionKey> keys = {};  // by rising time
    bool operator==(const GivenMotion&) const = default;

    /// From the first to the last frame or key, s.
    [[nodiscard]] double duration_s() const;
    /// The frames or keys between two times, both included. The times begin at 0.
    [[nodiscard]] GivenMotion between(double from_s, double to_s) const;
};

/// Largest number of frames: a project with such a motion and its plan is still small enough to be
/// read (512 MiB, see readBoundedJson()).
constexpr std::size_t kMostMotionFrames = 200'000;
constexpr std::size_t kMostMotionKeys = 1000;
/// Latest time of a frame or key, s.
constexpr double kLastMotionTime_s = 1e6;

/// What makes a motion unusable, as a sentence, and the frame or key concerned.
struct MotionFault {
    std::optional<std::size_t> frame;
    std::string text;
};

/// Checks the number of frames or keys, times (from 0 to 1e6 s, rising), positions (within 1000 km
/// of the origin) and quaternions (length 1).
[[nodiscard]] std::optional<MotionFault> findFault(const GivenMotion& motion);

/// Converts a trajectory; the times begin at 0.
[[nodiscard]] GivenMotion givenMotion(std::string name, const Trajectory& trajectory);

/// Converts the frames of a motion. Paths are numbered from 0 in the order of the frames; frames
/// have the default component and position along the path.
[[nodiscard]] Trajectory trajectoryOf(const GivenMotion& motion);

/// A motion as JSON: name, frame_interval_s and frames, one list of nine numbers for each; or name
/// and keys, one list of eight numbers for each. The numbers are read back to the last bit.
nlohmann::json motionJson(const GivenMotion& motion);

/// Reads what motionJson() writes. The name, the frame interval, and the path's number at the end
/// of each frame may be left out.
/// Records an error for a motion that findFault() rejects.
GivenMotion readMotion(const JsonReader& from);

/// A GivenMotion or none. Copies share it, so that undo steps take no memory for it; they are
/// compared by value.
class SharedMotion {
  public:
    SharedMotion() = default;
    SharedMotion(GivenMotion motion)  // NOLINT(google-explicit-constructor)
        : motion_(std::make_shared<const GivenMotion>(std::move(motion))) {}

    explicit operator bool() const { return motion_ != nullptr; }
    const GivenMotion& operator*() const { return *motion_; }
    const GivenMotion* operator->() const { return motion_.get(); }

    bool operator==(const SharedMotion& other) const {
        return motion_ == other.motion_ || (motion_ && other.motion_ && *motion_ == *other.motion_);
    }

  private:
    std::shared_ptr<const GivenMotion> motion_;
};

}  // namespace dollytrack
