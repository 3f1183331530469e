#include "engine/io/sandbox/frame_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

namespace dollytrack::io {
namespace {

/// Above those that a child is given its own meaning for.
constexpr int kLowestDescriptor = 10;

}  // namespace

Result<FrameMemory> FrameMemory::make(std::size_t size) {
    const int low = ::memfd_create("dollytrack-frame", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    const int descriptor = low < 0 ? -1 : ::fcntl(low, F_DUPFD_CLOEXEC, kLowestDescriptor);
    const int error = errno;
    if (low >= 0) ::close(low);
    FrameMemory memory(descriptor, size);
    if (descriptor < 0 || ::ftruncate(descriptor, static_cast<off_t>(size)) != 0 ||
        ::fcntl(descriptor, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) != 0) {
        return fail(ErrorCode::Failed, std::string("there is no memory to import into (") +
                                           std::strerror(descriptor < 0 ? error : errno) + ")");
    }
    return memory;
}

FrameMemory::~FrameMemory() {
    if (view_ != nullptr) ::munmap(view_, viewed_);
    if (descriptor_ >= 0) ::close(descriptor_);
}

FrameMemory::FrameMemory(FrameMemory&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      view_(std::exchange(other.view_, nullptr)),
      viewed_(other.viewed_) {}

FrameMemory& FrameMemory::operator=(FrameMemory&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(size_, other.size_);
    std::swap(view_, other.view_);
    std::swap(viewed_, other.viewed_);
    return *this;
}

Result<std::span<const std::uint8_t>> FrameMemory::close(std::size_t used) {
    if (used == 0 || used > size_ || view_ != nullptr ||
        ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_WRITE) != 0) {
        return fail(ErrorCode::BadInput, "what was handed back can still be written to");
    }
    void* view = ::mmap(nullptr, used, PROT_READ, MAP_SHARED | MAP_POPULATE, descriptor_, 0);
    if (view == MAP_FAILED) {
        return fail(ErrorCode::Failed, std::string("there is no memory for what was imported (") +
                                           std::strerror(errno) + ")");
    }
    view_ = view;
    viewed_ = used;
    return std::span(static_cast<const std::uint8_t*>(view), used);
}

}  // namespace dollytrack::io
