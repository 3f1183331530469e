#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_descriptor.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace dollytrack::io {

/// Memory without a name that another process fills: of a fixed size, so that it cannot be cut
/// under whoever reads it, and closed to all writers before it is read.
class FrameMemory {
  public:
    /// `size` bytes, or as many as the limit on file sizes leaves; none takes memory before it is
    /// written.
    [[nodiscard]] static Result<FrameMemory> make(std::size_t size);

    /// The first `used` bytes, for good as they are. Error: BadInput while somebody can write.
    [[nodiscard]] Result<std::span<const std::uint8_t>> close(std::size_t used);

    [[nodiscard]] int descriptor() const { return memory_.get(); }

  private:
    struct Unmap {
        std::size_t size;
        void operator()(const std::uint8_t* view) const;
    };

    FrameMemory(FileDescriptor memory, std::size_t size)
        : memory_(std::move(memory)), size_(size) {}

    FileDescriptor memory_;
    std::size_t size_ = 0;
    std::unique_ptr<const std::uint8_t, Unmap> view_;
};

}  // namespace dollytrack::io
