#pragma once

#include "engine/core/result.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// How a process ended.
struct ProcessEnd {
    int exit_code = -1;  // -1: it did not come to its own end
    int signal = 0;      // that ended it
};

/// A program that runs beside this one, in a process group of its own, with nothing to read and
/// its standard error as the only thing heard of it. It cannot outlive the thread that started it:
/// then the system ends it, however that thread came to its end. For one thread.
class ChildProcess {
  public:
    /// `command[0]` is the program's path. Failed when it cannot be run.
    [[nodiscard]] static Result<ChildProcess> start(const std::vector<std::string>& command);
    /// Kills it if it still runs.
    ~ChildProcess();
    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&&) = delete;
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Waits until it says something, or ends, or the time is over, and returns what it said.
    [[nodiscard]] std::string read(std::chrono::milliseconds wait);
    /// How it ended; nothing while it runs.
    [[nodiscard]] std::optional<ProcessEnd> end();
    /// Sends a signal to its whole group; nothing once end() has told of its end.
    void send(int signal) const;
    [[nodiscard]] int id() const { return process_; }

  private:
    ChildProcess(int process, int stderr_end) : process_(process), stderr_end_(stderr_end) {}

    int process_;
    int stderr_end_;
    std::optional<ProcessEnd> end_;
};

}  // namespace dollytrack::editor
