#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_descriptor.h"
#include "engine/io/sandbox/importer_protocol.h"

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// A running importer and the pipe for its messages. The destructor kills it and waits for it.
class SpawnedImporter {
  public:
    /// `arguments[0]` is the program. Error: Failed.
    [[nodiscard]] static Result<SpawnedImporter> start(const std::vector<std::string>& arguments,
                                                       int memory_descriptor);
    ~SpawnedImporter();
    SpawnedImporter(SpawnedImporter&& other) noexcept;
    SpawnedImporter& operator=(SpawnedImporter&&) = delete;

    /// Waits for messages for at most this time. Returns false if no more will come.
    [[nodiscard]] bool receive(std::chrono::milliseconds wait,
                               std::vector<ImporterMessage>& messages);
    /// The exit status, as from waitpid(); empty while it is running.
    [[nodiscard]] std::optional<int> end();
    void limitProcessorTime(std::uint64_t seconds) const;
    [[nodiscard]] pid_t process() const { return process_; }
    void kill() const;

  private:
    SpawnedImporter(pid_t process, FileDescriptor pipe)
        : process_(process), pipe_(std::move(pipe)) {}

    pid_t process_ = -1;
    FileDescriptor pipe_;
    std::string pending_;  // the beginning of a message
    std::optional<int> end_;
};

}  // namespace dollytrack
