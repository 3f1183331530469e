#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <string>

namespace dollytrack {

/// Measures how long a process was ready to run while all processors were busy with other work, by
/// the kernel's statistics (/proc/PID/task/*/schedstat). Zero if the kernel does not count it.
class ProcessorWait {
  public:
    using Seconds = std::chrono::duration<double>;

    /// The process must be a child of the caller that was not waited for yet.
    explicit ProcessorWait(pid_t process);
    /// Measures again and returns the total wait since construction. Each measurement adds the wait
    /// of the thread that waited longest since the last one; the total never exceeds the elapsed
    /// time.
    Seconds update();

  private:
    using Clock = std::chrono::steady_clock;

    Seconds waitedSinceLastLook();

    std::string folder_;
    std::map<std::string, Seconds> of_thread_;
    Clock::time_point begin_ = Clock::now();
    Seconds sum_{0.0};
};

}  // namespace dollytrack
