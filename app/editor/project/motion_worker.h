#pragma once

#include "app/editor/project/live_planner.h"
#include "engine/document/given_motion.h"
#include "engine/jobs/background_worker.h"
#include "planning/motions/camera_moves.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace dollytrack::editor {

/// A trajectory file, and the coordinate system of its positions (see TrajectoryReading; empty: the
/// format's).
struct MotionFile {
    std::filesystem::path path;
    std::string world;
    std::string format = {};  // set when it has been read
};

/// Reads, repairs and makes camera motions in the background. A newer request replaces an older
/// one.
class MotionWorker {
  public:
    enum class Source { File, Repair, Move, KeyTimes };
    struct Outcome {
        Source source = Source::File;
        GivenMotion motion;
        planning::MotionChange change = {};  // of a repair
        MotionFile file = {};                // that it was read from
        std::string note = {};  // of a move: how obstacles changed it; empty: not at all
        std::optional<Eigen::Vector3d> look_at = {};  // of a move: the point it looks at, m
        double floor_z = 0.0;  // of a move: the floor that its heights are above, world, m
    };

    explicit MotionWorker(std::function<void()> wake) : worker_(std::move(wake)) {}

    /// Reads a trajectory in any format of engine/io/trajectories.
    void read(const MotionFile& file, const PlanOutcome& shown);
    /// Repairs a motion in the displayed scene.
    void repair(const SharedMotion& motion, const PlanOutcome& shown);
    /// Makes a camera move: as further keys of the motion `after`, or as a new motion if `after` is
    /// null.
    void make(const planning::MoveRequest& move, const SharedMotion& after,
              const PlanOutcome& shown);
    /// Gives all keys of a motion times that the camera keeps.
    void fitKeys(const SharedMotion& motion, const PlanOutcome& shown);
    /// Cancels the request and drops its result.
    void cancel();

    [[nodiscard]] BackgroundWorker::State state() const { return worker_.state(); }
    /// The kind of the newest request.
    [[nodiscard]] Source source() const { return source_; }
    /// The newest result since the last call.
    [[nodiscard]] std::optional<Result<Outcome>> take();

  private:
    struct Answer {
        std::uint64_t question = 0;
        Result<Outcome> outcome;
    };
    using Work = std::function<Result<Outcome>(const JobContext&)>;
    void start(Source source, Work work);

    Source source_ = Source::File;
    std::uint64_t question_ = 0;
    std::shared_ptr<LatestValue<Answer>> answers_ = std::make_shared<LatestValue<Answer>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
