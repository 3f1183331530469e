#include "engine/io/files/durable_file.h"

#include "engine/io/files/guarded_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace dollytrack {
namespace {

constexpr std::string_view kTemporary = ".tmp.";

int writeTemporary(int folder, const std::string& name, std::span<const std::uint8_t> bytes,
                   Durability durability) {
    // Only new files are opened: an existing one may be a symbolic or hard link to another file.
    constexpr int kNew = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    FileDescriptor file(::openat(folder, name.c_str(), kNew, 0666));
    if (!file.valid() && errno == EEXIST && ::unlinkat(folder, name.c_str(), 0) == 0) {
        file = FileDescriptor(::openat(folder, name.c_str(), kNew, 0666));
    }
    if (!file.valid()) return errno;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (const int error = writeAll(file.get(), text)) return error;
    if (durability == Durability::Synced && ::fsync(file.get()) != 0) return errno;
    return file.close();
}

/// Syncs a folder, which makes a rename durable. EINVAL means that the file system does not support
/// it.
int syncDirectory(int folder) {
    const FileDescriptor directory(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!directory.valid()) return errno;
    return ::fsync(directory.get()) == 0 || errno == EINVAL ? 0 : errno;
}

std::filesystem::path folderOf(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

int writeAll(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        // Regular files accept at least one byte or fail; this prevents an endless loop in any
        // case.
        if (written == 0) return ENOSPC;
        bytes.remove_prefix(written);
    }
    return 0;
}

Error writeError(int error_number, const std::filesystem::path& path) {
    const auto sentence = [&]() -> std::string {
        switch (error_number) {
            case ENOSPC:
                return "the disk is full; free some space or choose another folder";
            case EDQUOT:
                return "the disk quota is used up; free some space or choose another folder";
            case EACCES:
            case EPERM:
                return "no permission to write here; choose another folder or change its rights";
            case EROFS:
                return "the file system is read-only; choose another folder";
            case ENOENT:
                return "the folder does not exist; create it or choose another one";
            case ENOTDIR:
                return "a part of the path is a file, not a folder; choose another path";
            case EISDIR:
                return "a folder has the name of this file; choose another name";
            case ENAMETOOLONG:
                return "the name is too long; choose a shorter one";
            case ENXIO:
                return "this is not an ordinary file; remove it or choose another folder";
            case EFBIG:
                return "the file grows beyond the limit set for this process or file system";
            default:
                return std::string("cannot write: ") + std::strerror(error_number);
        }
    }();
    return {ErrorCode::CannotWrite, sentence, path.string()};
}

int writeWholeAt(int folder, const std::string& name, std::span<const std::uint8_t> bytes,
                 Durability durability) {
    const std::string temporary = name + std::string(kTemporary) + std::to_string(::getpid());
    int error = writeTemporary(folder, temporary, bytes, durability);
    if (error == 0 && ::renameat(folder, temporary.c_str(), folder, name.c_str()) != 0) {
        error = errno;
    }
    if (error != 0) {
        ::unlinkat(folder, temporary.c_str(), 0);
        return error;
    }
    return durability == Durability::Synced ? syncDirectory(folder) : 0;
}

std::string_view completedName(std::string_view name) {
    const std::size_t end = name.rfind(kTemporary);
    if (end == std::string_view::npos) return name;
    const std::string_view process = name.substr(end + kTemporary.size());
    const bool numbered =
        !process.empty() && process.find_first_not_of("0123456789") == std::string_view::npos;
    return numbered ? name.substr(0, end) : name;
}

Status writeWhole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                  Durability durability) {
    const FileDescriptor folder(::open(folderOf(path).c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    const int error = folder.valid()
                          ? writeWholeAt(folder.get(), path.filename().string(), bytes, durability)
                          : errno;
    if (error != 0) return tl::unexpected(writeError(error, path));
    return {};
}

Status writeWhole(const std::filesystem::path& path, std::string_view text, Durability durability) {
    return writeWhole(path,
                      std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
                      durability);
}

Status syncFolder(const std::filesystem::path& folder) {
    const FileDescriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!directory.valid() || ::syncfs(directory.get()) != 0) {
        return tl::unexpected(writeError(errno, folder));
    }
    return {};
}

}  // namespace dollytrack
