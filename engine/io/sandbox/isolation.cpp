#include "engine/io/sandbox/isolation.h"

#include "engine/io/sandbox/folder_rules.h"
#include "engine/io/sandbox/syscall_filter.h"

#include <malloc.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>

namespace dollytrack {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // sanitizers' shadow memory needs terabytes of addresses
#else
constexpr bool kSanitized = false;
#endif

/// Sets all limits except that of processor time, which the parent sets, because it knows the
/// amount of work.
bool setLimits() {
    // Each malloc arena reserves 64 MiB of addresses.
    ::mallopt(M_ARENA_MAX, 2);
    bool all = ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
    // Core dumps that are piped to a program ignore RLIMIT_CORE, but not this.
    all = ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) == 0 && all;
    all = lowerLimit(RLIMIT_CORE, 0) && all;
    all = lowerLimit(RLIMIT_FSIZE, 0) && all;
    all = lowerLimit(RLIMIT_NOFILE, kMostOpenFiles) && all;
    if (!kSanitized) all = lowerLimit(RLIMIT_AS, kMostAddressSpace + kMostSerializedBytes) && all;
    // The returned data is in shared memory, which RLIMIT_DATA does not count.
    if (!kSanitized) all = lowerLimit(RLIMIT_DATA, kMostAddressSpace) && all;
    return all;
}

}  // namespace

bool lowerLimit(int resource, std::uint64_t most) {
    const auto kind = static_cast<__rlimit_resource>(resource);
    rlimit before{};
    if (::getrlimit(kind, &before) != 0) return false;
    const rlim_t lower = std::min<rlim_t>(most, before.rlim_max);
    const rlimit both{lower, lower};
    return ::setrlimit(kind, &both) == 0;
}

std::uint32_t isolateProcess(const std::vector<std::filesystem::path>& folders) {
    std::uint32_t missing = 0;
    if (!setLimits()) missing |= kLimits;
    const bool ruled = kSanitized || lockIntoFolders({folders});
    if (!ruled) missing |= kFolderRules;
    // A filter cannot check the flags of openat2(), which could write without Landlock.
    if (!kSanitized && !installSyscallFilter(ruled)) missing |= kCallFilter;
    return missing;
}

std::string layerNames(std::uint32_t layers) {
    std::string names;
    const auto add = [&](std::uint32_t layer, const char* name) {
        if ((layers & layer) == 0) return;
        names += (names.empty() ? "" : " and ") + std::string(name);
    };
    add(kLimits, "resource limits");
    add(kFolderRules, "Landlock");
    add(kCallFilter, "seccomp");
    return names;
}

}  // namespace dollytrack
