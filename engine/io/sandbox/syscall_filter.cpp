#include "engine/io/sandbox/syscall_filter.h"

#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>

namespace dollytrack {
namespace {

constexpr std::array kAllowed = {
    // reading files and folders
    SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(lseek), SCMP_SYS(close),
    SCMP_SYS(fstat), SCMP_SYS(newfstatat), SCMP_SYS(stat), SCMP_SYS(lstat), SCMP_SYS(statx),
    SCMP_SYS(access), SCMP_SYS(faccessat), SCMP_SYS(faccessat2), SCMP_SYS(readlink),
    SCMP_SYS(readlinkat), SCMP_SYS(getdents64), SCMP_SYS(getcwd), SCMP_SYS(fadvise64),
    // writing to the pipe to the parent and to stderr
    SCMP_SYS(write), SCMP_SYS(writev),
    // memory
    SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(brk), SCMP_SYS(madvise),
    // threads and time
    SCMP_SYS(futex), SCMP_SYS(set_robust_list), SCMP_SYS(rseq), SCMP_SYS(sched_yield),
    SCMP_SYS(sched_getaffinity), SCMP_SYS(getcpu), SCMP_SYS(gettid), SCMP_SYS(getpid),
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep),
    SCMP_SYS(gettimeofday), SCMP_SYS(getrandom), SCMP_SYS(sysinfo), SCMP_SYS(uname),
    SCMP_SYS(restart_syscall),
    // exit and signals
    SCMP_SYS(exit), SCMP_SYS(exit_group), SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask),
    SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack)};

class Filter {
  public:
    Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(EPERM)), &seccomp_release) {}

    void allow(int call) { add(SCMP_ACT_ALLOW, call, {}); }
    void refuse(int call, int error) {
        add(SCMP_ACT_ERRNO(static_cast<unsigned>(error)), call, {});
    }
    /// Allows a call if the masked argument has this value.
    void allowIf(int call, unsigned argument, scmp_datum_t mask, scmp_datum_t value) {
        add(SCMP_ACT_ALLOW, call, {{argument, SCMP_CMP_MASKED_EQ, mask, value}});
    }
    [[nodiscard]] bool load() { return good_ && context_ && seccomp_load(context_.get()) == 0; }

  private:
    void add(std::uint32_t action, int call, std::initializer_list<scmp_arg_cmp> conditions) {
        // The call does not exist on this architecture.
        if (call < 0) return;
        good_ = good_ && context_ &&
                seccomp_rule_add_array(context_.get(), action, call,
                                       static_cast<unsigned>(conditions.size()),
                                       conditions.begin()) == 0;
    }

    std::unique_ptr<void, decltype(&seccomp_release)> context_;
    bool good_ = true;
};

}  // namespace

bool installSyscallFilter(bool openat2) {
    Filter filter;
    for (const int call : kAllowed) filter.allow(call);
    constexpr scmp_datum_t kWriting = O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND;
    filter.allowIf(SCMP_SYS(open), 1, kWriting, O_RDONLY);
    filter.allowIf(SCMP_SYS(openat), 2, kWriting, O_RDONLY);
    if (openat2) {
        filter.allow(SCMP_SYS(openat2));
    } else {
        filter.refuse(SCMP_SYS(openat2), ENOSYS);
    }
    filter.allowIf(SCMP_SYS(mmap), 2, PROT_EXEC, 0);
    filter.allowIf(SCMP_SYS(mprotect), 2, PROT_EXEC, 0);
    // Only threads, not processes. The flags of clone3() cannot be filtered; if it is refused,
    // glibc uses clone().
    filter.allowIf(SCMP_SYS(clone), 0, CLONE_THREAD, CLONE_THREAD);
    filter.refuse(SCMP_SYS(clone3), ENOSYS);
    filter.allowIf(SCMP_SYS(prlimit64), 2, ~scmp_datum_t{0}, 0);
    // Listing folders needs these operations on descriptors.
    filter.allowIf(SCMP_SYS(fcntl), 1, ~scmp_datum_t{0}, F_GETFL);
    filter.allowIf(SCMP_SYS(fcntl), 1, ~scmp_datum_t{0}, F_SETFD);
    // abort() sends a signal to its own process.
    filter.allowIf(SCMP_SYS(tgkill), 0, ~scmp_datum_t{0}, static_cast<scmp_datum_t>(::getpid()));
    filter.refuse(SCMP_SYS(ioctl), ENOTTY);
    return filter.load();
}

}  // namespace dollytrack
