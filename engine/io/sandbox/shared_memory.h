#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_descriptor.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace dollytrack {

/// Anonymous shared memory that another process fills. Its size is fixed, so it cannot be truncated
/// while it is read, and it is sealed against writing before it is read.
class SharedMemory {
  public:
    /// Creates memory of `size` bytes, or of as many as the limit on file sizes allows. Pages take
    /// memory only once they are written.
    [[nodiscard]] static Result<SharedMemory> make(std::size_t size);

    /// Seals the memory and returns its first `used` bytes, which nobody can change any more.
    /// Error: BadInput if another process still has it mapped for writing after some seconds.
    [[nodiscard]] Result<std::span<const std::uint8_t>> close(std::size_t used);

    [[nodiscard]] int descriptor() const { return memory_.get(); }

  private:
    struct Unmap {
        std::size_t size;
        void operator()(const std::uint8_t* view) const;
    };

    SharedMemory(FileDescriptor memory, std::size_t size)
        : memory_(std::move(memory)), size_(size) {}

    FileDescriptor memory_;
    std::size_t size_ = 0;
    std::unique_ptr<const std::uint8_t, Unmap> view_;
};

}  // namespace dollytrack
