#include "app/editor/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

namespace dollytrack::editor {
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

/// Runs in the child, which has but this one thread: other threads may have held any lock when it
/// was made, so nothing here allocates, or calls what is not safe in a signal handler.
[[noreturn]] void becomeProgram(char* const* arguments, pid_t parent, int stderr_end,
                                int failure_end) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // The parent may have died before it was asked to take this one along.
    if (getppid() != parent) _exit(127);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGCHLD, SIGQUIT}) {
        std::signal(signal, SIG_DFL);
    }
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(stderr_end, STDERR_FILENO);
    // Files, sockets and devices of libraries that forgot to mark them.
    close_range(3, UINT_MAX, CLOSE_RANGE_CLOEXEC);
    execv(arguments[0], arguments);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = write(failure_end, &error, sizeof(error));
    _exit(127);
}

tl::unexpected<Error> cannotStart(const std::string& program, int error) {
    return fail(ErrorCode::Failed,
                std::string("The program cannot be started: ") + std::strerror(error) + ".",
                program);
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& command) {
    Pipe words;
    Pipe failure;
    if (!words.open() || !failure.open()) return cannotStart(command[0], errno);
    std::vector<char*> arguments;
    for (const std::string& argument : command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) return cannotStart(command[0], errno);
    if (child == 0) {
        becomeProgram(arguments.data(), parent, words.write_end, failure.write_end);
    }
    // Here as well: whichever comes first, a signal to the group must find it.
    setpgid(child, child);
    words.closeWriteEnd();
    failure.closeWriteEnd();
    ChildProcess process(child, std::exchange(words.read_end, -1));
    int error = 0;
    ssize_t got = 0;
    do {
        got = ::read(failure.read_end, &error, sizeof(error));
    } while (got < 0 && errno == EINTR);
    if (got == sizeof(error)) return cannotStart(command[0], error);
    fcntl(process.stderr_end_, F_SETFL, O_NONBLOCK);
    return process;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      stderr_end_(std::exchange(other.stderr_end_, -1)),
      end_(other.end_) {}

ChildProcess::~ChildProcess() {
    if (process_ > 0 && !end_) {
        send(SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    if (stderr_end_ >= 0) close(stderr_end_);
}

std::string ChildProcess::read(std::chrono::milliseconds wait) {
    if (stderr_end_ < 0) {
        // It closed its standard error and goes on; poll() would not wait for nothing.
        if (!end_) std::this_thread::sleep_for(wait);
        return {};
    }
    pollfd watched{stderr_end_, POLLIN, 0};
    if (poll(&watched, 1, static_cast<int>(wait.count())) <= 0) return {};
    std::string text(1 << 16, '\0');
    const ssize_t got = ::read(stderr_end_, text.data(), text.size());
    if (got == 0) {
        close(stderr_end_);
        stderr_end_ = -1;
    }
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return text;
}

std::optional<ProcessEnd> ChildProcess::end() {
    int status = 0;
    if (!end_ && waitpid(process_, &status, WNOHANG) == process_) {
        end_ = WIFEXITED(status) ? ProcessEnd{WEXITSTATUS(status), 0}
                                 : ProcessEnd{-1, WTERMSIG(status)};
    }
    return end_;
}

void ChildProcess::send(int signal) const {
    // Once it is waited for, its number may belong to somebody else.
    if (process_ > 0 && !end_) kill(-process_, signal);
}

}  // namespace dollytrack::editor
