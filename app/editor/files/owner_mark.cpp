#include "app/editor/files/owner_mark.h"

#include "app/editor/files/folder_entries.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <utility>
#include <vector>

namespace dollytrack::editor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockEnding = ".lock";

/// Start time of a process in clock ticks since boot; empty if it does not exist.
std::string startOf(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t end_of_name = text.rfind(')');
    if (end_of_name == std::string::npos) return {};
    std::size_t at = end_of_name + 2;
    for (int field = 3; field < 22; ++field) at = text.find(' ', at) + 1;
    return text.substr(at, text.find(' ', at) - at);
}

/// The host name, without characters that separate the parts of a mark.
std::string hostName() {
    std::array<char, 256> name{};
    if (gethostname(name.data(), name.size() - 1) != 0) return "host";
    std::string text = name.data();
    std::ranges::replace_if(
        text, [](unsigned char c) { return std::isalnum(c) == 0 && c != '.'; }, '_');
    return text.empty() ? "host" : text;
}

/// Looks up the process of a mark "host-process-start"; older marks have no host.
bool processRuns(std::string_view mark) {
    const std::size_t before_start = mark.rfind('-');
    if (before_start == std::string_view::npos) return false;
    const std::string_view start = mark.substr(before_start + 1);
    mark = mark.substr(0, before_start);
    const std::size_t before_process = mark.rfind('-');
    if (before_process != std::string_view::npos) {
        if (mark.substr(0, before_process) != hostName()) return true;
        mark = mark.substr(before_process + 1);
    }
    int process = 0;
    const auto parsed = std::from_chars(mark.data(), mark.data() + mark.size(), process);
    if (parsed.ec != std::errc() || parsed.ptr != mark.data() + mark.size() || process <= 0) {
        return false;
    }
    return startOf(process) == start;
}

fs::path lockFile(const fs::path& folder, std::string_view mark) {
    return folder / (std::string(mark) + kLockEnding);
}

struct flock wholeFile() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

}  // namespace

OwnerMark::OwnerMark(fs::path folder)
    : folder_(std::move(folder)),
      text_(hostName() + "-" + std::to_string(getpid()) + "-" + startOf(getpid())) {}

OwnerMark::~OwnerMark() {
    if (lock_ < 0) return;
    std::error_code ignored;
    fs::remove(lockFile(folder_, text_), ignored);
    close(lock_);
}

void OwnerMark::hold() {
    if (lock_ >= 0) return;
    std::error_code ignored;
    fs::create_directories(folder_, ignored);
    const int file = open(lockFile(folder_, text_).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0) return;
    // An open-file-description lock: closing another descriptor in this process must not release
    // it.
    struct flock lock = wholeFile();
    if (fcntl(file, F_OFD_SETLK, &lock) == 0) {
        lock_ = file;
    } else {
        close(file);
    }
}

bool OwnerMark::isHeld(const fs::path& folder, std::string_view mark) {
    const int file = open(lockFile(folder, mark).c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) return processRuns(mark);
    struct flock lock = wholeFile();
    const bool answered = fcntl(file, F_OFD_GETLK, &lock) == 0;
    close(file);
    return answered ? lock.l_type != F_UNLCK : processRuns(mark);
}

void OwnerMark::tidy(const fs::path& folder) {
    std::error_code ignored;
    std::vector<fs::path> left_over;
    for (const fs::directory_entry& entry : entriesOf(folder)) {
        const fs::path& file = entry.path();
        if (file.extension() != kLockEnding) continue;
        // A lock file that is being created is not locked yet, but its process runs.
        const std::string mark = file.stem().string();
        if (!isHeld(folder, mark) && !processRuns(mark)) left_over.push_back(file);
    }
    for (const fs::path& file : left_over) fs::remove(file, ignored);
}

FolderLock::FolderLock(const fs::path& folder) {
    // Never removed: waiting processes must find the same file.
    lock_ = open((folder / ".taking-over").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    struct flock lock = wholeFile();
    while (lock_ >= 0 && fcntl(lock_, F_OFD_SETLKW, &lock) != 0 && errno == EINTR) {
    }
}

FolderLock::~FolderLock() {
    if (lock_ >= 0) close(lock_);
}

}  // namespace dollytrack::editor
