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
    int exit_code = -1;            // -1: ended by a signal
    int signal = 0;                // the signal that ended it; 0: none
    std::uint64_t peak_bytes = 0;  // peak memory (resident set size)
};

/// Output, limits and priority of a child process.
struct ProcessSetup {
    int output = -1;                 // file descriptor for its standard output; -1: discarded
    int messages = -1;               // the same for standard error; -1: readable with read()
    std::uint64_t memory_bytes = 0;  // limit of its data (RLIMIT_DATA); 0: none
    bool expendable = false;         // the system ends it first when memory is short
};

/// A child process in a process group of its own, with empty standard input. It cannot outlive the
/// thread that started it: when that thread ends for any reason, the system kills the process. Not
/// thread-safe.
class ChildProcess {
  public:
    /// Starts a program; `command[0]` is its path. Error: Failed if it cannot be run.
    [[nodiscard]] static Result<ChildProcess> start(const std::vector<std::string>& command,
                                                    const ProcessSetup& setup = {});
    /// Kills the process group if it still runs.
    ~ChildProcess();
    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&&) = delete;
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Waits for output on standard error, its end, or the timeout, and returns the output.
    [[nodiscard]] std::string read(std::chrono::milliseconds wait);
    /// How the process ended; nullopt while it runs.
    [[nodiscard]] std::optional<ProcessEnd> end();
    /// Sends a signal to the process group; does nothing after end() has returned a value.
    void send(int signal) const;
    [[nodiscard]] int id() const { return process_; }

  private:
    ChildProcess(int process, int heard_end) : process_(process), heard_end_(heard_end) {}

    int process_;
    int heard_end_;  // read end of the pipe; -1: closed or not used
    std::optional<ProcessEnd> end_;
};

}  // namespace dollytrack
