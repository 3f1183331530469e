#include "engine/io/files/confined_folder.h"

#include "engine/io/files/input_record.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostEntries = 20'000;
constexpr int kMostLevels = 5;
constexpr int kOpenFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

std::string realPath(const std::string& path) {
    const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr),
                                                           &std::free);
    return real ? std::string(real.get()) : std::string();
}

/// Fallback for kernels without openat2(): the resolved path must begin with that of the folder.
/// Changes by another program between the check and opening are not noticed.
int openByRealPath(const fs::path& folder, const std::string& relative) {
    const std::string root = realPath(folder.string());
    const std::string file = realPath((folder / relative).string());
    if (root.empty() || file.empty()) return -1;
    if (root != "/" && !file.starts_with(root + "/")) {
        errno = EXDEV;
        return -1;
    }
    return ::open(file.c_str(), kOpenFlags | O_NOFOLLOW);
}

Error cannotOpen(int error, const std::string& name) {
    if (error == EXDEV || error == ELOOP) {
        return {
            ErrorCode::BadInput,
            "the file is outside the scene's folder and was not opened; copy it into that folder",
            name};
    }
    return {ErrorCode::BadInput,
            std::string("the file cannot be opened (") + std::strerror(error) + ")", name};
}

/// Whether a regular file has this path. Readers also try parts of names, so only names of existing
/// files are reported as outside the folder.
bool isOrdinaryFile(const fs::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

bool leadsOut(int error, const fs::path& path) {
    return (error == EXDEV || error == ELOOP) && isOrdinaryFile(path);
}

}  // namespace

ConfinedFolder::ConfinedFolder(fs::path folder)
    : folder_(folder.empty() ? fs::path(".") : std::move(folder)) {}

std::string ConfinedFolder::relative(const fs::path& file) const {
    std::string name = file.string();
    const std::string own = folder_.string();
    const std::string prefix = own.ends_with('/') ? own : own + "/";
    if (name.starts_with(prefix)) {
        name.erase(0, prefix.size());
        const std::string beneath = name.substr(std::min(name.find_first_not_of('/'), name.size()));
        // Readers also prepend the folder to absolute names.
        const bool absolute = beneath.size() < name.size() && !openDescriptor(beneath).valid() &&
                              isOrdinaryFile("/" + beneath);
        name = absolute ? "/" + beneath : beneath;
    }
    if (name.starts_with('/')) {  // it may lead back into the folder
        std::error_code error;
        const std::string root = fs::absolute(folder_, error).lexically_normal().string();
        const std::string all = root.ends_with('/') ? root : root + "/";
        if (!error && name.starts_with(all)) name.erase(0, all.size());
    }
    return name;
}

FileDescriptor ConfinedFolder::openDescriptor(const std::string& relative) const {
    // Opened for each file, because a scene made of models may have more folders than a process may
    // have descriptors. O_PATH: the folder itself need not be readable.
    const FileDescriptor folder(::open(folder_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!folder.valid()) return FileDescriptor();
    open_how how{};
    how.flags = kOpenFlags;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
    long opened = -1;
    do {  // EAGAIN: a rename happened during the lookup
        opened = ::syscall(SYS_openat2, folder.get(), relative.c_str(), &how, sizeof(how));
    } while (opened < 0 && (errno == EINTR || errno == EAGAIN));
    if (opened < 0 && (errno == ENOSYS || errno == EPERM)) {
        if (relative.starts_with('/')) {
            errno = EXDEV;
            return FileDescriptor();
        }
        return FileDescriptor(openByRealPath(folder_, relative));
    }
    return FileDescriptor(static_cast<int>(opened));
}

Result<InputFile> ConfinedFolder::open(const fs::path& file) const {
    const std::string name = file.string();
    if (name.find('\0') != std::string::npos) {
        return tl::unexpected(cannotOpen(ENOENT, name));
    }
    FileDescriptor descriptor = openDescriptor(name);
    if (!descriptor.valid()) {
        const int error = errno;
        const bool outside = leadsOut(error, folder_ / name);
        InputRecord::note(outside ? InputUse::Refused : InputUse::Missing, folder_ / name);
        return tl::unexpected(cannotOpen(error, name));
    }
    Result<InputFile> opened = InputFile::adopt(std::move(descriptor), name);
    InputRecord::note(opened ? InputUse::File : InputUse::Missing, folder_ / name,
                      opened ? opened->identity() : FileIdentity{});
    return opened;
}

bool ConfinedFolder::has(const fs::path& file) const {
    const std::string name = file.string();
    const FileDescriptor descriptor =
        name.find('\0') == std::string::npos ? openDescriptor(name) : FileDescriptor();
    const int error = errno;
    struct stat status {};
    const bool regular =
        descriptor.valid() && ::fstat(descriptor.get(), &status) == 0 && S_ISREG(status.st_mode);
    if (!regular) {
        const bool outside = !descriptor.valid() && leadsOut(error, folder_ / name);
        InputRecord::note(outside ? InputUse::Refused : InputUse::Missing, folder_ / name);
    }
    return regular;
}

std::vector<fs::path> ConfinedFolder::list() const {
    InputRecord::note(InputUse::Listing, folder_);
    std::vector<fs::path> files;
    std::error_code error;
    std::size_t seen = 0;
    std::vector<fs::path> level = {fs::path()};
    for (int depth = 0; depth < kMostLevels && !level.empty() && seen < kMostEntries; ++depth) {
        std::vector<fs::path> next;
        for (const fs::path& folder : level) {
            std::vector<fs::directory_entry> entries;
            fs::directory_iterator it(folder_ / folder, error);
            for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
                if (++seen >= kMostEntries) break;
                entries.push_back(*it);
            }
            std::sort(entries.begin(), entries.end());
            for (const fs::directory_entry& entry : entries) {
                if (entry.is_symlink(error)) continue;
                const fs::path name = folder / entry.path().filename();
                if (entry.is_directory(error)) {
                    next.push_back(name);
                } else if (entry.is_regular_file(error)) {
                    files.push_back(name);
                }
            }
        }
        level = std::move(next);
    }
    return files;
}

bool hasFile(const fs::path& file) {
    return ConfinedFolder(file.parent_path()).has(file.filename());
}

}  // namespace dollytrack
