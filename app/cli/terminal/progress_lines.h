#pragma once

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <atomic>
#include <memory>

namespace dollytrack::cli {

/// Progress for programs that run this one, as JSON objects on stderr, one per line:
///   {"stage": "frames", "fraction": 0.41, "frames_done": 12, "frames": 30, "frames_per_s": 8.1,
///    "seconds_left": 2.2}       at most ten per second; fields that are unknown are omitted
///   {"log": {"level": "warning", "subsystem": "import", "message": "...", "repeats": 1}}
/// and at the end one of
///   {"done": true, "exit_code": 0, "seconds": 4.2, "frames_done": 30, "frames": 30}
///   {"error": {"code": "cannot_write", "exit_code": 6, "message": "...", "where": "..."}}
class ProgressLines {
  public:
    ProgressLines();

    /// A job context that reports through these lines and is cancelled by the flag.
    [[nodiscard]] JobContext context(std::shared_ptr<const std::atomic<bool>> cancel_flag) const;
    [[nodiscard]] static log::Sink logSink();

    void finish(int exit_code) const;
    static void fail(const Error& error, int exit_code);

  private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace dollytrack::cli
