#include "engine/io/sandbox/confined_program.h"

#include "engine/io/sandbox/folder_rules.h"

#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace dollytrack {
namespace {

constexpr std::array kRefused = {
    // other processes
    SCMP_SYS(kill), SCMP_SYS(tkill), SCMP_SYS(ptrace), SCMP_SYS(process_vm_readv),
    SCMP_SYS(process_vm_writev), SCMP_SYS(pidfd_send_signal), SCMP_SYS(pidfd_getfd),
    // the system
    SCMP_SYS(mount), SCMP_SYS(umount2), SCMP_SYS(pivot_root), SCMP_SYS(chroot), SCMP_SYS(unshare),
    SCMP_SYS(setns), SCMP_SYS(bpf), SCMP_SYS(perf_event_open), SCMP_SYS(userfaultfd),
    SCMP_SYS(io_uring_setup), SCMP_SYS(keyctl), SCMP_SYS(add_key), SCMP_SYS(request_key),
    SCMP_SYS(init_module), SCMP_SYS(finit_module), SCMP_SYS(kexec_load), SCMP_SYS(swapon),
    SCMP_SYS(swapoff), SCMP_SYS(reboot), SCMP_SYS(settimeofday), SCMP_SYS(clock_settime),
    SCMP_SYS(sethostname), SCMP_SYS(setdomainname)};

bool refuseCalls() {
    const std::unique_ptr<void, decltype(&seccomp_release)> filter(seccomp_init(SCMP_ACT_ALLOW),
                                                                   &seccomp_release);
    if (!filter) return false;
    constexpr std::uint32_t kDenied = SCMP_ACT_ERRNO(EPERM);
    bool good = true;
    for (const int call : kRefused) {
        good = (call < 0 || seccomp_rule_add(filter.get(), kDenied, call, 0) == 0) && good;
    }
    good = seccomp_rule_add(filter.get(), kDenied, SCMP_SYS(socket), 0) == 0 && good;
    // abort() sends a signal to its own process, whose id stays when the program is replaced.
    good = seccomp_rule_add(filter.get(), kDenied, SCMP_SYS(tgkill), 1,
                            SCMP_A0(SCMP_CMP_NE, static_cast<scmp_datum_t>(::getpid()))) == 0 &&
           good;
    return good && seccomp_load(filter.get()) == 0;
}

bool limit(__rlimit_resource resource, rlim_t most) {
    rlimit found{};
    if (::getrlimit(resource, &found) != 0) return false;
    const rlimit both{std::min(most, found.rlim_max), std::min(most, found.rlim_max)};
    return ::setrlimit(resource, &both) == 0;
}

bool confine(const std::filesystem::path& work, const std::filesystem::path& folder) {
    constexpr rlim_t kGiB = rlim_t{1} << 30U;
    constexpr rlim_t kMostSeconds = 3600;  // of processor time
    const FolderRights rights{{folder, "/etc", "/proc", "/sys", "/dev/urandom", "/dev/random"},
                              {"/usr", "/bin", "/lib", "/lib64", "/opt"},
                              {work, "/dev/null"}};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && limit(RLIMIT_CORE, 0) &&
           limit(RLIMIT_FSIZE, 4 * kGiB) && limit(RLIMIT_DATA, 8 * kGiB) &&
           limit(RLIMIT_CPU, kMostSeconds) && lockIntoFolders(rights) && refuseCalls();
}

}  // namespace

int runConfined(int count, char** arguments) {
    constexpr int kProgram = 5;
    if (count <= kProgram || std::string(arguments[1]) != kConfine) return 2;
    // The parent may have died before PR_SET_PDEATHSIG was set.
    if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || std::to_string(::getppid()) != arguments[2]) {
        return 2;
    }
    const std::string work = arguments[3];
    if (!confine(work, arguments[4])) return 3;
    // Nothing of the user's environment: neither secrets nor settings that change the result.
    const std::array<std::string, 5> values = {"PATH=/usr/local/bin:/usr/bin:/bin", "LANG=C.UTF-8",
                                               "HOME=" + work, "TMPDIR=" + work,
                                               "XDG_RUNTIME_DIR=" + work};
    std::array<char*, 6> environment = {};
    std::ranges::transform(values, environment.begin(), [](const std::string& value) {
        return const_cast<char*>(value.data());
    });
    ::execve(arguments[kProgram], arguments + kProgram, environment.data());
    return 4;
}

}  // namespace dollytrack
