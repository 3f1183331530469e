#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace dollytrack::fuzz {

/// Bytes in memory as a file with a path, for readers that need a path.
class MemoryFile {
  public:
    MemoryFile(const std::uint8_t* data, std::size_t size) {
        descriptor_ = memfd_create("fuzz", MFD_CLOEXEC);
        if (descriptor_ < 0 || write(descriptor_, data, size) != static_cast<ssize_t>(size)) {
            std::abort();
        }
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    [[nodiscard]] std::filesystem::path path() const {
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

  private:
    int descriptor_ = -1;
};

}  // namespace dollytrack::fuzz
