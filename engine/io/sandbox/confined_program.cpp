#include "engine/io/sandbox/confined_program.h"

#include "engine/io/sandbox/folder_rules.h"
#include "engine/io/sandbox/isolation.h"

#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>

namespace dollytrack {
namespace {

constexpr std::array kRefused = {
    // other processes
    SCMP_SYS(kill), SCMP_SYS(tkill), SCMP_SYS(rt_sigqueueinfo), SCMP_SYS(rt_tgsigqueueinfo),
    SCMP_SYS(ptrace), SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev),
    SCMP_SYS(process_madvise), SCMP_SYS(pidfd_send_signal), SCMP_SYS(pidfd_getfd),
    SCMP_SYS(setpriority), SCMP_SYS(ioprio_set), SCMP_SYS(sched_setscheduler),
    SCMP_SYS(sched_setparam), SCMP_SYS(sched_setattr), SCMP_SYS(fork), SCMP_SYS(vfork),
    SCMP_SYS(setsid), SCMP_SYS(setpgid), SCMP_SYS(shmget), SCMP_SYS(shmat), SCMP_SYS(shmctl),
    SCMP_SYS(msgget), SCMP_SYS(semget), SCMP_SYS(mq_open),
    // attributes and truncation of files, which Landlock does not restrict on all kernels
    SCMP_SYS(chmod), SCMP_SYS(fchmod), SCMP_SYS(fchmodat), SCMP_SYS(chown), SCMP_SYS(fchown),
    SCMP_SYS(lchown), SCMP_SYS(fchownat), SCMP_SYS(utime), SCMP_SYS(utimes), SCMP_SYS(utimensat),
    SCMP_SYS(futimesat), SCMP_SYS(setxattr), SCMP_SYS(lsetxattr), SCMP_SYS(fsetxattr),
    SCMP_SYS(removexattr), SCMP_SYS(lremovexattr), SCMP_SYS(fremovexattr), SCMP_SYS(truncate),
    // the system
    SCMP_SYS(mount), SCMP_SYS(umount2), SCMP_SYS(fsopen), SCMP_SYS(fsmount), SCMP_SYS(move_mount),
    SCMP_SYS(open_tree), SCMP_SYS(pivot_root), SCMP_SYS(chroot), SCMP_SYS(unshare), SCMP_SYS(setns),
    SCMP_SYS(bpf), SCMP_SYS(perf_event_open), SCMP_SYS(userfaultfd), SCMP_SYS(io_uring_setup),
    SCMP_SYS(keyctl), SCMP_SYS(add_key), SCMP_SYS(request_key), SCMP_SYS(init_module),
    SCMP_SYS(finit_module), SCMP_SYS(kexec_load), SCMP_SYS(swapon), SCMP_SYS(swapoff),
    SCMP_SYS(reboot), SCMP_SYS(settimeofday), SCMP_SYS(clock_settime), SCMP_SYS(sethostname),
    SCMP_SYS(setdomainname), SCMP_SYS(socket), SCMP_SYS(socketpair)};

/// A filter that allows every call but those that are refused.
class Refusals {
  public:
    Refusals() : filter_(seccomp_init(SCMP_ACT_ALLOW), &seccomp_release) {}

    /// Refuses a call, or only if its arguments meet the conditions.
    void refuse(int call, std::initializer_list<scmp_arg_cmp> conditions = {}, int error = EPERM) {
        if (call < 0) return;  // the call does not exist on this architecture
        good_ = good_ && filter_ &&
                seccomp_rule_add_array(
                    filter_.get(), SCMP_ACT_ERRNO(static_cast<std::uint32_t>(error)), call,
                    static_cast<unsigned>(conditions.size()), conditions.begin()) == 0;
    }
    [[nodiscard]] bool load() { return good_ && filter_ && seccomp_load(filter_.get()) == 0; }

  private:
    std::unique_ptr<void, decltype(&seccomp_release)> filter_;
    bool good_ = true;
};

bool refuseCalls() {
    Refusals filter;
    for (const int call : kRefused) filter.refuse(call);
    // Only threads, not processes; glibc falls back to clone() if clone3() is not known.
    filter.refuse(SCMP_SYS(clone), {{0, SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0}});
    filter.refuse(SCMP_SYS(clone3), {}, ENOSYS);
    // The flags of openat2() cannot be filtered.
    filter.refuse(SCMP_SYS(openat2), {}, ENOSYS);
    constexpr scmp_datum_t kTruncatesUnwritten = O_ACCMODE | O_TRUNC;
    filter.refuse(SCMP_SYS(open), {{1, SCMP_CMP_MASKED_EQ, kTruncatesUnwritten, O_TRUNC}});
    filter.refuse(SCMP_SYS(openat), {{2, SCMP_CMP_MASKED_EQ, kTruncatesUnwritten, O_TRUNC}});
    filter.refuse(SCMP_SYS(prlimit64), {{0, SCMP_CMP_NE, 0, 0}});
    // abort() sends a signal to its own process, whose id stays when the program is replaced.
    filter.refuse(SCMP_SYS(tgkill), {{0, SCMP_CMP_NE, static_cast<scmp_datum_t>(::getpid()), 0}});
    return filter.load();
}

bool confine(const std::filesystem::path& work, const std::filesystem::path& folder) {
    constexpr std::uint64_t kMostFileBytes = std::uint64_t{4} << 30U;
    constexpr std::uint64_t kMostSeconds = 3600;  // of processor time
    const FolderRights rights{
        {folder, "/etc", "/proc/self", "/proc/cpuinfo", "/proc/meminfo", "/proc/stat",
         "/proc/filesystems", "/proc/sys/vm", "/sys", "/dev/urandom", "/dev/random"},
        {"/usr", "/bin", "/lib", "/lib64", "/opt"},
        {work, "/dev/null"}};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && lowerLimit(RLIMIT_CORE, 0) &&
           lowerLimit(RLIMIT_FSIZE, kMostFileBytes) && lowerLimit(RLIMIT_DATA, kMostConfinedData) &&
           lowerLimit(RLIMIT_CPU, kMostSeconds) && lockIntoFolders(rights) && refuseCalls();
}

}  // namespace

int runConfined(int count, char** arguments) {
    constexpr int kProgram = 5;
    if (count <= kProgram || std::string(arguments[1]) != kConfine) return kWrongArguments;
    // The parent may have died before PR_SET_PDEATHSIG was set.
    if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || std::to_string(::getppid()) != arguments[2]) {
        return kWrongArguments;
    }
    const std::string work = arguments[3];
    if (!confine(work, arguments[4])) return kCannotConfine;
    // Nothing of the user's environment: neither secrets nor settings that change the result.
    const std::array<std::string, 5> values = {"PATH=/usr/local/bin:/usr/bin:/bin", "LANG=C.UTF-8",
                                               "HOME=" + work, "TMPDIR=" + work,
                                               "XDG_RUNTIME_DIR=" + work};
    std::array<char*, 6> environment = {};
    std::ranges::transform(values, environment.begin(), [](const std::string& value) {
        return const_cast<char*>(value.data());
    });
    ::execve(arguments[kProgram], arguments + kProgram, environment.data());
    return kCannotStart;
}

}  // namespace dollytrack
