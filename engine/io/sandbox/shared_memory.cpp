#include "engine/io/sandbox/shared_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <utility>

namespace dollytrack {
namespace {

/// Above the descriptors with a fixed meaning in the child.
constexpr int kLowestDescriptor = 10;

Error noMemory(int error) {
    // EINVAL: the requested descriptor is above the limit.
    if (error == EMFILE || error == ENFILE || error == EINVAL) {
        return {
            ErrorCode::Failed,
            "the limit on open files is too low to read scenes; raise it (ulimit -n) to 64 or more",
            {}};
    }
    return {ErrorCode::Failed,
            std::string("there is not enough memory for the imported scene (") +
                std::strerror(error) + ")",
            {}};
}

/// Seals the memory against writing. The kernel refuses with EBUSY while the memory is mapped for
/// writing and, on a busy machine, for a short time afterwards, while it still uses some pages
/// itself. Therefore tries again for some seconds. Returns whether the memory is sealed.
bool sealAgainstWriting(int memory) {
    constexpr auto kLongest = std::chrono::seconds(5);
    constexpr auto kPause = std::chrono::milliseconds(10);
    const auto end = std::chrono::steady_clock::now() + kLongest;
    while (::fcntl(memory, F_ADD_SEALS, F_SEAL_WRITE) != 0) {
        if (errno != EBUSY || std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(kPause);
    }
    return true;
}

}  // namespace

Result<SharedMemory> SharedMemory::make(std::size_t size) {
    // The file size limit also applies to memory files; most scenes need little.
    rlimit files{};
    if (::getrlimit(RLIMIT_FSIZE, &files) == 0) size = std::min<std::size_t>(size, files.rlim_cur);
    const FileDescriptor low(::memfd_create("dollytrack-frame", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    FileDescriptor high(low.valid() ? ::fcntl(low.get(), F_DUPFD_CLOEXEC, kLowestDescriptor) : -1);
    if (!high.valid() || ::ftruncate(high.get(), static_cast<off_t>(size)) != 0 ||
        ::fcntl(high.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) != 0) {
        return tl::unexpected(noMemory(errno));
    }
    return SharedMemory(std::move(high), size);
}

void SharedMemory::Unmap::operator()(const std::uint8_t* view) const {
    ::munmap(const_cast<std::uint8_t*>(view), size);
}

Result<std::span<const std::uint8_t>> SharedMemory::close(std::size_t used) {
    if (used == 0 || used > size_) {
        return fail(ErrorCode::BadInput, "its length is none");
    }
    if (view_ || !sealAgainstWriting(memory_.get())) {
        return fail(ErrorCode::BadInput, "the returned data can still be modified");
    }
    void* view = ::mmap(nullptr, used, PROT_READ, MAP_SHARED | MAP_POPULATE, memory_.get(), 0);
    if (view == MAP_FAILED) {
        return fail(ErrorCode::Failed,
                    std::string("there is not enough memory for the imported scene (") +
                        std::strerror(errno) + ")");
    }
    view_ = {static_cast<const std::uint8_t*>(view), Unmap{used}};
    return std::span(view_.get(), used);
}

}  // namespace dollytrack
