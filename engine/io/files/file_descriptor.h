#pragma once

#include <unistd.h>

#include <cerrno>
#include <utility>

namespace dollytrack {

/// A file descriptor that is closed with this object; -1 is none.
class FileDescriptor {
  public:
    FileDescriptor() = default;
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    ~FileDescriptor() { (void)close(); }
    FileDescriptor(FileDescriptor&& other) noexcept
        : descriptor_(std::exchange(other.descriptor_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }

    [[nodiscard]] int get() const { return descriptor_; }
    [[nodiscard]] bool valid() const { return descriptor_ >= 0; }

    /// NFS and quotas report a failed write only here. 0 or errno; errno itself stays as it was.
    [[nodiscard]] int close() {
        const int descriptor = std::exchange(descriptor_, -1);
        if (descriptor < 0) return 0;
        const int before = errno;
        const int error = ::close(descriptor) == 0 || errno == EINTR ? 0 : errno;
        errno = before;
        return error;
    }

  private:
    int descriptor_ = -1;
};

}  // namespace dollytrack
