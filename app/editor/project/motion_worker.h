#pragma once

#include "app/editor/project/live_planner.h"
#include "engine/document/given_motion.h"
#include "engine/jobs/background_worker.h"
#include "planning/motions/repair_motion.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace dollytrack::editor {

/// Reads, repairs and makes camera motions in the background. A newer request replaces an older
/// one.
class MotionWorker {
  public:
    struct Outcome {
        GivenMotion motion;
        std::optional<planning::MotionChange> change;  // unset: as the file has it
    };

    explicit MotionWorker(std::function<void()> wake) : worker_(std::move(wake)) {}

    /// Reads a trajectory in any format of engine/io/trajectories. `world`: its coordinate system,
    /// see TrajectoryReading; empty: the format's.
    void read(const std::filesystem::path& file, const std::string& world,
              const PlanOutcome& shown);
    /// Repairs the motion of the displayed plan.
    void repair(const PlanOutcome& shown);
    /// Makes a move, given as on the command line: "orbit:target=sofa".
    void make(const std::string& move, const PlanOutcome& shown);
    /// Cancels the request and drops its result.
    void cancel();

    [[nodiscard]] BackgroundWorker::State state() const { return worker_.state(); }
    /// The newest result since the last call.
    [[nodiscard]] std::optional<Result<Outcome>> take();

  private:
    struct Answer {
        std::uint64_t question = 0;
        Result<Outcome> outcome;
    };
    using Work = std::function<Result<Outcome>(const JobContext&)>;
    void start(Work work);

    std::uint64_t question_ = 0;
    std::shared_ptr<LatestValue<Answer>> answers_ = std::make_shared<LatestValue<Answer>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
