#include "engine/io/sandbox/spawned_importer.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <utility>

namespace dollytrack {
namespace {

constexpr int kLowestDescriptor = 10;

/// Makes a pipe whose descriptors are above the fixed ones of the child.
bool makePipe(FileDescriptor& read_end, FileDescriptor& write_end) {
    std::array<int, 2> low{};
    if (::pipe2(low.data(), O_CLOEXEC) != 0) return false;
    const FileDescriptor low_read(low[0]);
    const FileDescriptor low_write(low[1]);
    read_end = FileDescriptor(::fcntl(low[0], F_DUPFD_CLOEXEC, kLowestDescriptor));
    write_end = FileDescriptor(::fcntl(low[1], F_DUPFD_CLOEXEC, kLowestDescriptor));
    return read_end.valid() && write_end.valid();
}

/// The child's environment: that of this process, with huge pages for malloc. Model readers
/// allocate buffers of 16 MiB, whose 4096 page faults would take a third of the time of a small
/// file.
std::vector<std::string> environmentOfChild() {
    constexpr std::string_view kTunables = "GLIBC_TUNABLES=";
    std::string tunables(kTunables);
    std::vector<std::string> lines;
    for (char** line = environ; *line != nullptr; ++line) {
        const std::string_view text = *line;
        if (text.starts_with(kTunables)) {
            tunables = std::string(text) + ":";
        } else {
            lines.emplace_back(text);
        }
    }
    lines.push_back(tunables + "glibc.malloc.hugetlb=1");
    return lines;
}

/// A null-terminated array for exec; valid as long as `lines`.
std::vector<char*> pointersTo(std::vector<std::string>& lines) {
    std::vector<char*> pointers;
    pointers.reserve(lines.size() + 1);
    for (std::string& line : lines) pointers.push_back(line.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Starts the importer with only the two descriptors open, in a process group of its own and
/// without the parent's signal mask.
int spawn(std::vector<std::string> arguments, int memory, int pipe, pid_t& process) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDWR, 0);
    posix_spawn_file_actions_adddup2(&files, STDIN_FILENO, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, STDIN_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&files, memory, kMemoryDescriptor);
    posix_spawn_file_actions_adddup2(&files, pipe, kMessageDescriptor);
    posix_spawn_file_actions_addclosefrom_np(&files, kMessageDescriptor + 1);
    posix_spawnattr_t look;
    posix_spawnattr_init(&look);
    sigset_t none;
    sigset_t all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&look, &none);
    posix_spawnattr_setsigdefault(&look, &all);
    posix_spawnattr_setpgroup(&look, 0);
    posix_spawnattr_setflags(
        &look, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    const std::vector<char*> words = pointersTo(arguments);
    std::vector<std::string> environment = environmentOfChild();
    const std::vector<char*> variables = pointersTo(environment);
    const int error =
        posix_spawn(&process, words[0], &files, &look, words.data(), variables.data());
    posix_spawnattr_destroy(&look);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

}  // namespace

Result<SpawnedImporter> SpawnedImporter::start(const std::vector<std::string>& arguments,
                                               int memory_descriptor) {
    FileDescriptor read_end;
    FileDescriptor write_end;
    int error = makePipe(read_end, write_end) ? 0 : errno;
    pid_t process = -1;
    if (error == 0) error = spawn(arguments, memory_descriptor, write_end.get(), process);
    (void)write_end.close();  // otherwise the end of the messages would not be noticed
    if (error == 0) {
        ::fcntl(read_end.get(), F_SETFL, O_NONBLOCK);
        return SpawnedImporter(process, std::move(read_end));
    }
    const std::string hint =
        error == ENOENT ? "it must be in the folder of this program; build or install it again"
                        : std::strerror(error);
    return fail(ErrorCode::Failed, "the program that reads scene files cannot be started: " + hint,
                arguments[0]);
}

SpawnedImporter::SpawnedImporter(SpawnedImporter&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      pipe_(std::move(other.pipe_)),
      pending_(std::move(other.pending_)),
      end_(other.end_) {}

SpawnedImporter::~SpawnedImporter() {
    if (process_ > 0 && !end()) {
        kill();
        while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
}

bool SpawnedImporter::receive(std::chrono::milliseconds wait,
                              std::vector<ImporterMessage>& messages) {
    pollfd watched{pipe_.get(), POLLIN, 0};
    if (::poll(&watched, 1, static_cast<int>(wait.count())) <= 0) return true;
    std::array<char, 4096> bytes{};
    const ssize_t got = ::read(pipe_.get(), bytes.data(), bytes.size());
    if (got < 0) return errno == EINTR || errno == EAGAIN;
    if (got == 0) return false;
    pending_.append(bytes.data(), static_cast<std::size_t>(got));
    std::size_t at = 0;
    for (; pending_.size() - at >= sizeof(ImporterMessage); at += sizeof(ImporterMessage)) {
        std::memcpy(&messages.emplace_back(), pending_.data() + at, sizeof(ImporterMessage));
    }
    pending_.erase(0, at);
    return true;
}

std::optional<int> SpawnedImporter::end() {
    int status = 0;
    if (end_) return end_;
    const pid_t ended = ::waitpid(process_, &status, WNOHANG);
    // ECHILD: SIGCHLD is ignored (inherited from the parent), so there is no exit status; the
    // returned data shows whether the importer succeeded.
    if (ended == process_ || (ended < 0 && errno == ECHILD)) end_ = status;
    return end_;
}

void SpawnedImporter::limitProcessorTime(std::uint64_t seconds) const {
    rlimit limit{};
    if (::prlimit(process_, RLIMIT_CPU, nullptr, &limit) != 0) return;
    // Only the soft limit is set, because a lowered hard limit cannot be raised for a large scene.
    limit.rlim_cur = std::min<rlim_t>(seconds, limit.rlim_max);
    ::prlimit(process_, RLIMIT_CPU, &limit, nullptr);
}

void SpawnedImporter::kill() const {
    // After waitpid() its process id may belong to another process.
    if (process_ > 0 && !end_) ::kill(process_, SIGKILL);
}

}  // namespace dollytrack
