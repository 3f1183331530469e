#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace dollytrack::io {

/// Memory without a name that another process fills: of a fixed size, so that it cannot be cut
/// under whoever reads it, and closed to all writers before it is read.
class FrameMemory {
  public:
    /// `size` bytes, of which none takes memory before it is written.
    [[nodiscard]] static Result<FrameMemory> make(std::size_t size);
    ~FrameMemory();
    FrameMemory(FrameMemory&& other) noexcept;
    FrameMemory& operator=(FrameMemory&& other) noexcept;

    /// The first `used` bytes, for good as they are. Error: BadInput while somebody can write.
    [[nodiscard]] Result<std::span<const std::uint8_t>> close(std::size_t used);

    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    FrameMemory(int descriptor, std::size_t size) : descriptor_(descriptor), size_(size) {}

    int descriptor_ = -1;
    std::size_t size_ = 0;
    void* view_ = nullptr;
    std::size_t viewed_ = 0;
};

}  // namespace dollytrack::io
