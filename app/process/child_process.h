#pragma once

#include "engine/core/result.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// How a process ended.
struct ProcessEnd {
    int exit_code = -1;            // -1: it did not come to its own end
    int signal = 0;                // that ended it
    std::uint64_t peak_bytes = 0;  // the most memory that it held at a time
};

/// How a program runs, and who hears it.
struct ProcessSetup {
    int output = -1;                 // descriptor of a file for its standard output; -1: nobody
    int messages = -1;               // likewise for its standard error; -1: read() hears it
    std::uint64_t memory_bytes = 0;  // of its own data (RLIMIT_DATA), at most; 0: without limit
    bool expendable = false;         // the first one that the system ends when memory is short
};

/// A program that runs beside this one, in a process group of its own, with nothing to read and
/// what it says heard here or kept in files. It cannot outlive the thread that started it:
/// then the system ends it, however that thread came to its end. For one thread.
class ChildProcess {
  public:
    /// `command[0]` is the program's path. Error: Failed when it cannot be run.
    [[nodiscard]] static Result<ChildProcess> start(const std::vector<std::string>& command,
                                                    const ProcessSetup& setup = {});
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
    ChildProcess(int process, int heard_end) : process_(process), heard_end_(heard_end) {}

    int process_;
    int heard_end_;  // of a pipe; -1: nothing is to be heard
    std::optional<ProcessEnd> end_;
};

}  // namespace dollytrack
