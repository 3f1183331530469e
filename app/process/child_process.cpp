#include "app/process/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

namespace dollytrack {
namespace {

struct Pipe {
    int read_end = -1;
    int write_end = -1;

    bool open() {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) return false;
        read_end = ends[0];
        write_end = ends[1];
        return true;
    }
    void closeWriteEnd() {
        if (write_end >= 0) close(write_end);
        write_end = -1;
    }
    ~Pipe() {
        closeWriteEnd();
        if (read_end >= 0) close(read_end);
    }
};

/// Arguments of the child, prepared before the fork.
struct Becoming {
    char* const* arguments = nullptr;
    pid_t parent = 0;
    int output = -1;  // file descriptors; -1: /dev/null
    int messages = -1;
    int failure_end = -1;  // pipe that reports a failed exec to the parent
    rlim_t memory = RLIM_INFINITY;
    bool expendable = false;
};

/// Runs in the forked child, which has only this thread: other threads may have held any lock
/// during the fork, so only async-signal-safe functions are allowed, and no allocation.
[[noreturn]] void becomeProgram(const Becoming& wanted) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // The parent may have died before prctl() took effect.
    if (getppid() != wanted.parent) _exit(127);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD, SIGQUIT}) {
        std::signal(signal, SIG_DFL);
    }
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(wanted.output >= 0 ? wanted.output : nothing, STDOUT_FILENO);
    dup2(wanted.messages >= 0 ? wanted.messages : nothing, STDERR_FILENO);
    if (wanted.memory != RLIM_INFINITY) {
        const rlimit limit{wanted.memory, wanted.memory};
        // Not RLIMIT_AS: libraries and threads reserve far more addresses than they use.
        setrlimit(RLIMIT_DATA, &limit);
    }
    if (wanted.expendable) {
        const int score = open("/proc/self/oom_score_adj", O_WRONLY);
        [[maybe_unused]] const ssize_t told = write(score, "1000", 4);
    }
    // Descriptors that libraries opened without close-on-exec.
    close_range(3, UINT_MAX, CLOSE_RANGE_CLOEXEC);
    execv(wanted.arguments[0], wanted.arguments);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = write(wanted.failure_end, &error, sizeof(error));
    _exit(127);
}

bool isStopped(pid_t child) {
    siginfo_t found{};
    return waitid(P_PID, static_cast<id_t>(child), &found, WSTOPPED | WNOHANG | WNOWAIT) == 0 &&
           found.si_pid == child;
}

/// The errno of a failed exec; 0 on success, or if the child was suspended before: then it counts
/// as running, and the caller decides how long to wait.
int failureOf(pid_t child, int failure_end) {
    constexpr int kLook_ms = 50;
    pollfd watched{failure_end, POLLIN, 0};
    while (poll(&watched, 1, kLook_ms) <= 0) {
        if (isStopped(child)) return 0;
    }
    int error = 0;
    ssize_t got = 0;
    do {
        got = ::read(failure_end, &error, sizeof(error));
    } while (got < 0 && errno == EINTR);
    return got == sizeof(error) ? error : 0;
}

tl::unexpected<Error> cannotStart(const std::string& program, int error) {
    return fail(ErrorCode::Failed,
                std::string("The program cannot be started: ") + std::strerror(error) + ".",
                program);
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& command,
                                         const ProcessSetup& setup) {
    Pipe words;
    Pipe failure;
    const bool heard = setup.messages < 0;
    if ((heard && !words.open()) || !failure.open()) return cannotStart(command[0], errno);
    std::vector<char*> arguments;
    for (const std::string& argument : command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    const Becoming wanted{
        arguments.data(),  getpid(),
        setup.output,      heard ? words.write_end : setup.messages,
        failure.write_end, setup.memory_bytes > 0 ? setup.memory_bytes : RLIM_INFINITY,
        setup.expendable};
    const pid_t child = fork();
    if (child < 0) return cannotStart(command[0], errno);
    if (child == 0) becomeProgram(wanted);
    // In parent and child, so that the group exists before the first signal, whichever runs first.
    setpgid(child, child);
    // If the terminal stopped it while it was still in our group, nothing else would continue it.
    kill(-child, SIGCONT);
    words.closeWriteEnd();
    failure.closeWriteEnd();
    ChildProcess process(child, std::exchange(words.read_end, -1));
    if (const int error = failureOf(child, failure.read_end); error != 0) {
        return cannotStart(command[0], error);
    }
    if (heard) fcntl(process.heard_end_, F_SETFL, O_NONBLOCK);
    return process;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      heard_end_(std::exchange(other.heard_end_, -1)),
      end_(other.end_) {}

ChildProcess::~ChildProcess() {
    if (process_ > 0 && !end_) {
        send(SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    if (heard_end_ >= 0) close(heard_end_);
}

std::string ChildProcess::read(std::chrono::milliseconds wait) {
    if (heard_end_ < 0) {
        // Without a pipe, poll() would return at once.
        if (!end_) std::this_thread::sleep_for(wait);
        return {};
    }
    pollfd watched{heard_end_, POLLIN, 0};
    if (poll(&watched, 1, static_cast<int>(wait.count())) <= 0) return {};
    std::string text(1 << 16, '\0');
    const ssize_t got = ::read(heard_end_, text.data(), text.size());
    if (got == 0) {
        close(heard_end_);
        heard_end_ = -1;
    }
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return text;
}

std::optional<ProcessEnd> ChildProcess::end() {
    int status = 0;
    rusage usage{};
    if (!end_ && wait4(process_, &status, WNOHANG, &usage) == process_) {
        end_ = WIFEXITED(status) ? ProcessEnd{WEXITSTATUS(status), 0}
                                 : ProcessEnd{-1, WTERMSIG(status)};
        end_->peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
    }
    return end_;
}

void ChildProcess::send(int signal) const {
    // After wait4() the process id may be reused.
    if (process_ > 0 && !end_) kill(-process_, signal);
}

}  // namespace dollytrack
