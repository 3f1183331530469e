#include "engine/io/sandbox/folder_rules.h"

#include "engine/io/files/file_descriptor.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace dollytrack {
namespace {

/// The kernel's landlock_ruleset_attr in the newest version used here; Debian 12's header has only
/// the first member. Older kernels accept a shorter struct.
struct Ruleset {
    std::uint64_t files = 0;
    std::uint64_t network = 0;  // since version 4
    std::uint64_t scoped = 0;   // since version 6
};

struct Version {
    long number;
    unsigned file_rights;  // number of bits
    unsigned network_rights;
    unsigned scopes;
    std::size_t size;  // size of the struct
};
constexpr std::array<Version, 5> kVersions = {
    {{6, 16, 2, 2, 24}, {5, 16, 2, 0, 16}, {4, 15, 2, 0, 16}, {3, 15, 0, 0, 8}, {1, 13, 0, 0, 8}}};

std::uint64_t bits(unsigned count) {
    return (std::uint64_t{1} << count) - 1;
}

/// Allows these rights below a folder, or those of them that a file can have on a file.
bool allow(int rules, const std::filesystem::path& path, std::uint64_t rights) {
    const FileDescriptor place(::open(path.c_str(), O_PATH | O_CLOEXEC));
    if (!place.valid()) return true;  // does not exist, so needs no rule
    struct stat status {};
    const bool folder = ::fstat(place.get(), &status) == 0 && S_ISDIR(status.st_mode);
    constexpr std::uint64_t kOfFiles =
        LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE;
    landlock_path_beneath_attr rule{};
    rule.parent_fd = place.get();
    rule.allowed_access = folder ? rights : rights & kOfFiles;
    return ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
}

}  // namespace

bool lockIntoFolders(const FolderRights& rights) {
    const long version =
        ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1) return false;
    FileDescriptor rules;
    std::uint64_t file_rights = 0;
    for (const Version& known : kVersions) {
        if (version < known.number) continue;
        file_rights = bits(known.file_rights);
        const Ruleset wanted{file_rights, bits(known.network_rights), bits(known.scopes)};
        rules = FileDescriptor(
            static_cast<int>(::syscall(SYS_landlock_create_ruleset, &wanted, known.size, 0)));
        break;
    }
    if (!rules.valid()) return false;
    constexpr std::uint64_t kReading = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
    constexpr std::uint64_t kExecuting = LANDLOCK_ACCESS_FS_EXECUTE;
    const auto allowAll = [&](const std::vector<std::filesystem::path>& paths,
                              std::uint64_t allowed) {
        return std::ranges::all_of(paths, [&](const std::filesystem::path& path) {
            return allow(rules.get(), path, allowed);
        });
    };
    const bool locked = allowAll(rights.readable, kReading) &&
                        allowAll(rights.executable, kReading | kExecuting) &&
                        allowAll(rights.writable, file_rights & ~kExecuting);
    return locked && ::syscall(SYS_landlock_restrict_self, rules.get(), 0) == 0;
}

}  // namespace dollytrack
