#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <string>

namespace dollytrack::io {

/// How long a process was ready to run while all processors were taken by others, as the kernel
/// counts it (proc/PID/task/*/schedstat). Zero where it does not count.
class ProcessorWait {
  public:
    using Seconds = std::chrono::duration<double>;

    /// The process has to be the caller's child, not yet waited for.
    explicit ProcessorWait(pid_t process);
    /// Looks again, and gives the sum so far: of all looks what the thread that waited longest
    /// since the last has waited, from when this was made on; never more than the time that passed.
    Seconds update();

  private:
    using Clock = std::chrono::steady_clock;

    Seconds waitedSinceLastLook();

    std::string folder_;
    std::map<std::string, Seconds> of_thread_;
    Clock::time_point begin_ = Clock::now();
    Seconds sum_{0.0};
};

}  // namespace dollytrack::io
