#include "engine/io/files/guarded_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

// O_PATH needs only the right to search a folder.
constexpr int kStep = O_PATH | O_DIRECTORY | O_CLOEXEC;

std::optional<struct stat> statusAt(int folder, const std::string& name) {
    struct stat status {};
    if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return std::nullopt;
    return status;
}

/// A readable descriptor of the same folder, which can be synced.
FileDescriptor readable(int folder) {
    return FileDescriptor(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

FileDescriptor openStep(int folder, const std::string& name, bool make) {
    FileDescriptor step(::openat(folder, name.c_str(), kStep | O_NOFOLLOW));
    if (step.valid() || errno != ENOENT || !make) return step;
    if (::mkdirat(folder, name.c_str(), 0777) != 0 && errno != EEXIST) return FileDescriptor();
    return FileDescriptor(::openat(folder, name.c_str(), kStep | O_NOFOLLOW));
}

}  // namespace

/// The parent folder and the file name of a relative name.
struct GuardedFolder::Place {
    FileDescriptor step;  // owns `folder`, except for the guarded folder itself
    int folder = -1;
    std::string name;
    fs::path around;  // path of `folder`
};

GuardedFolder::GuardedFolder(fs::path path, FileDescriptor folder)
    : path_(std::move(path)), folder_(std::make_shared<const FileDescriptor>(std::move(folder))) {}

Result<GuardedFolder> GuardedFolder::open(const fs::path& folder) {
    FileDescriptor opened(::open(folder.empty() ? "." : folder.c_str(), kStep));
    if (!opened.valid()) return tl::unexpected(writeError(errno, folder));
    return GuardedFolder(folder, std::move(opened));
}

Result<GuardedFolder> GuardedFolder::make(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return tl::unexpected(writeError(error.value(), folder));
    return open(folder);  // create_directories accepts a file instead of a folder
}

Result<GuardedFolder> GuardedFolder::makeBelow(const fs::path& folder, const fs::path& root) {
    if (root.empty()) return make(folder);
    Result<GuardedFolder> around = make(root);
    const fs::path name = folder.lexically_normal().lexically_relative(root.lexically_normal());
    if (!around || name == ".") return around;
    return around->makeWithin(name.has_filename() ? name.string() : name.parent_path().string());
}

bool GuardedFolder::isPlain(std::string_view name) {
    if (name.empty() || name.find('\0') != std::string_view::npos) return false;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        const std::string_view part = name.substr(begin, end - begin);
        if (part.empty() || part == "." || part == "..") return false;
        begin = end + 1;
    }
    return true;
}

tl::unexpected<Error> GuardedFolder::failure(int error, const Place& at) const {
    const fs::path path = at.around / at.name;
    const auto found = statusAt(at.folder, at.name);
    if (found && S_ISLNK(found->st_mode) && (error == ELOOP || error == ENOTDIR)) {
        return fail(ErrorCode::CannotWrite,
                    "a symbolic link is in its place and is not followed; remove it or choose "
                    "another folder",
                    path.string());
    }
    return tl::unexpected(writeError(error, path));
}

int GuardedFolder::walk(const std::string& name, bool make, Place& place) const {
    std::size_t begin = 0;
    for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', begin)) {
        place.name = name.substr(begin, end - begin);
        FileDescriptor step = openStep(place.folder, place.name, make);
        if (!step.valid()) return errno;
        place.step = std::move(step);
        place.folder = place.step.get();
        place.around /= place.name;
        begin = end + 1;
    }
    place.name = name.substr(begin);
    return 0;
}

Result<std::optional<GuardedFolder::Place>> GuardedFolder::findPlace(const std::string& name,
                                                                     bool make) const {
    if (!isPlain(name)) {
        return fail(ErrorCode::CannotWrite,
                    "the name '" + name + "' leads out of the folder, so it is not used",
                    path_.string());
    }
    Place place{{}, folder_->get(), {}, path_};
    const int error = walk(name, make, place);
    if (error == ENOENT) return std::nullopt;
    if (error != 0) return failure(error, place);
    return std::optional<Place>(std::move(place));
}

Result<GuardedFolder::Place> GuardedFolder::placeOf(const std::string& name, bool make) const {
    Result<std::optional<Place>> place = findPlace(name, make);
    if (!place) return tl::unexpected(place.error());
    if (!*place) return tl::unexpected(writeError(ENOENT, path_ / name));
    return std::move(**place);
}

Result<GuardedFolder> GuardedFolder::within(const std::string& name, bool make) const {
    Result<Place> place = placeOf(name, make);
    if (!place) return tl::unexpected(place.error());
    FileDescriptor opened = openStep(place->folder, place->name, make);
    if (!opened.valid()) return failure(errno, *place);
    return GuardedFolder(path_ / name, std::move(opened));
}

Result<GuardedFolder> GuardedFolder::makeWithin(const std::string& name) const {
    return within(name, true);
}

Result<GuardedFolder> GuardedFolder::openWithin(const std::string& name) const {
    return within(name, false);
}

Result<FileDescriptor> GuardedFolder::openFile(const std::string& name, int flags) const {
    const Result<Place> place = placeOf(name, (flags & O_CREAT) != 0);
    if (!place) return tl::unexpected(place.error());
    // Truncated only after the check that the file has no other hard link.
    const int safe = (flags & ~O_TRUNC) | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
    FileDescriptor file(::openat(place->folder, place->name.c_str(), safe, 0666));
    struct stat status {};
    if (!file.valid() || ::fstat(file.get(), &status) != 0) return failure(errno, *place);
    if (!S_ISREG(status.st_mode)) return failure(S_ISDIR(status.st_mode) ? EISDIR : ENXIO, *place);
    if ((flags & O_ACCMODE) != O_RDONLY && status.st_nlink > 1) {
        return fail(ErrorCode::CannotWrite,
                    "the file has a second name (a hard link) and is not written to; remove it or "
                    "choose another folder",
                    (path_ / name).string());
    }
    return file;
}

Result<FileDescriptor> GuardedFolder::openEmptied(const std::string& name) const {
    Result<FileDescriptor> file = openFile(name, O_WRONLY | O_CREAT);
    if (file && ::ftruncate(file->get(), 0) != 0) {
        return tl::unexpected(writeError(errno, path_ / name));
    }
    return file;
}

GuardedFolder::Stream GuardedFolder::openStream(const std::string& name) const {
    Result<FileDescriptor> file = openFile(name, O_RDONLY);
    if (!file) return Stream(nullptr, &std::fclose);
    return Stream(::fdopen(::fcntl(file->get(), F_DUPFD_CLOEXEC, 0), "rb"), &std::fclose);
}

Result<InputFile> GuardedFolder::openInput(const std::string& name) const {
    Result<FileDescriptor> file = openFile(name, O_RDONLY);
    if (!file) return tl::unexpected(file.error());
    return InputFile::adopt(std::move(*file), (path_ / name).string());
}

std::optional<std::vector<std::uint8_t>> GuardedFolder::read(const std::string& name) const {
    const Stream file = openStream(name);
    struct stat status {};
    if (!file || ::fstat(::fileno(file.get()), &status) != 0) return std::nullopt;
    std::vector<std::uint8_t> bytes(status.st_size);
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    if (bytes.size() != static_cast<std::size_t>(status.st_size)) return std::nullopt;
    return bytes;
}

std::optional<struct stat> GuardedFolder::find(const std::string& name) const {
    const Result<Place> place = placeOf(name, false);
    return place ? statusAt(place->folder, place->name) : std::nullopt;
}

Result<std::vector<std::string>> GuardedFolder::list(const std::string& name) const {
    std::vector<std::string> names;
    FileDescriptor folder;
    if (name.empty()) {
        folder = readable(folder_->get());
        if (!folder.valid()) return tl::unexpected(writeError(errno, path_));
    } else {
        const Result<std::optional<Place>> place = findPlace(name, false);
        if (!place) return tl::unexpected(place.error());
        if (!*place) return names;
        folder = FileDescriptor(::openat((*place)->folder, (*place)->name.c_str(),
                                         O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
        if (!folder.valid() && errno == ENOENT) return names;
        if (!folder.valid()) return failure(errno, **place);
    }
    DIR* reading = ::fdopendir(::fcntl(folder.get(), F_DUPFD_CLOEXEC, 0));
    if (reading == nullptr) return tl::unexpected(writeError(errno, path_ / name));
    errno = 0;
    while (const dirent* entry = ::readdir(reading)) {
        const std::string_view found = entry->d_name;
        if (found != "." && found != "..") names.emplace_back(found);
    }
    const int error = errno;
    ::closedir(reading);
    if (error != 0) return tl::unexpected(writeError(error, path_ / name));
    std::ranges::sort(names);
    return names;
}

Status GuardedFolder::checkFolder(const std::string& name) const {
    std::string so_far;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        so_far = name.substr(0, end);
        if (!has(so_far)) return {};
        if (const auto step = openWithin(so_far); !step) return tl::unexpected(step.error());
        begin = end + 1;
    }
    return {};
}

Status GuardedFolder::checkFile(const std::string& name) const {
    const Result<std::optional<Place>> place = findPlace(name, false);
    if (!place) return tl::unexpected(place.error());
    if (!*place) return {};
    const auto found = statusAt((*place)->folder, (*place)->name);
    if (found && S_ISLNK(found->st_mode)) return failure(ELOOP, **place);
    if (found && S_ISDIR(found->st_mode)) return failure(EISDIR, **place);
    return {};
}

Status GuardedFolder::write(const std::string& name, std::span<const std::uint8_t> bytes,
                            Durability durability) const {
    const Result<Place> place = placeOf(name, true);
    if (!place) return tl::unexpected(place.error());
    const auto found = statusAt(place->folder, place->name);
    // Replacing a symbolic link would be safe, but the user may need it.
    if (found && S_ISLNK(found->st_mode)) return failure(ELOOP, *place);
    if (const int error = writeWholeAt(place->folder, place->name, bytes, durability)) {
        return failure(error, *place);
    }
    return {};
}

Status GuardedFolder::write(const std::string& name, std::string_view text,
                            Durability durability) const {
    return write(name, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
                 durability);
}

Result<bool> GuardedFolder::move(const std::string& name, const GuardedFolder& to,
                                 const std::string& new_name) const {
    const Result<std::optional<Place>> from = findPlace(name, false);
    if (!from) return tl::unexpected(from.error());
    if (!*from) return false;
    const Result<Place> place = to.placeOf(new_name, true);
    if (!place) return tl::unexpected(place.error());
    if (::renameat((*from)->folder, (*from)->name.c_str(), place->folder, place->name.c_str()) !=
        0) {
        if (errno == ENOENT) return false;
        return to.failure(errno, *place);
    }
    return true;
}

Status GuardedFolder::link(const std::string& name, const std::string& new_name) const {
    const Result<Place> from = placeOf(name, false);
    if (!from) return tl::unexpected(from.error());
    const Result<Place> to = placeOf(new_name, true);
    if (!to) return tl::unexpected(to.error());
    if (Status removed = remove(new_name); !removed) return removed;
    if (::linkat(from->folder, from->name.c_str(), to->folder, to->name.c_str(), 0) == 0) return {};
    const auto bytes = read(name);
    if (!bytes) return tl::unexpected(writeError(errno, path_ / name));
    return write(new_name, *bytes, Durability::Renamed);
}

Status GuardedFolder::remove(const std::string& name) const {
    const Result<std::optional<Place>> place = findPlace(name, false);
    if (!place) return tl::unexpected(place.error());
    if (*place && ::unlinkat((*place)->folder, (*place)->name.c_str(), 0) != 0 && errno != ENOENT) {
        return failure(errno, **place);
    }
    return {};
}

void GuardedFolder::removeEmpty(const std::string& name) const {
    for (std::string at = name; !at.empty();) {
        const Result<Place> place = placeOf(at, false);
        if (place && ::unlinkat(place->folder, place->name.c_str(), AT_REMOVEDIR) != 0) return;
        const std::size_t slash = at.rfind('/');
        at.resize(slash == std::string::npos ? 0 : slash);
    }
}

Status GuardedFolder::syncNames() const {
    const FileDescriptor folder = readable(folder_->get());
    // EINVAL: the file system does not support it.
    if (folder.valid() && (::fsync(folder.get()) == 0 || errno == EINVAL)) return {};
    return tl::unexpected(writeError(errno, path_));
}

Status GuardedFolder::syncAll() const {
    const FileDescriptor folder = readable(folder_->get());
    if (folder.valid() && ::syncfs(folder.get()) == 0) return {};
    return tl::unexpected(writeError(errno, path_));
}

std::optional<std::uint64_t> GuardedFolder::freeBytes() const {
    struct statvfs space {};
    if (::fstatvfs(folder_->get(), &space) != 0 || space.f_blocks == 0) return std::nullopt;
    return std::uint64_t{space.f_bavail} * space.f_frsize;
}

}  // namespace dollytrack
