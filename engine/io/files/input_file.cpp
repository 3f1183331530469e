#include "engine/io/files/input_file.h"

#include "engine/io/files/input_record.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace dollytrack {
namespace {

std::int64_t nanoseconds(const timespec& time) {
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

Result<InputFile> InputFile::adopt(FileDescriptor file, const std::string& where) {
    struct stat status {};
    if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
        return fail(ErrorCode::BadInput, "this is not an ordinary file", where);
    }
    const FileIdentity identity{status.st_dev, status.st_ino,
                                static_cast<std::uint64_t>(status.st_size),
                                nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
    return InputFile(std::move(file), identity, where);
}

std::size_t InputFile::read(std::uint64_t offset, void* into, std::size_t size) const {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::pread(file_.get(), static_cast<char*>(into) + done, size - done,
                                    static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

Result<std::string> InputFile::readAll(std::uint64_t most) const {
    if (size() > most) {
        const bool small = most < std::uint64_t{1} << 20U;
        return fail(
            ErrorCode::BadInput,
            "the file is larger than " +
                (small ? std::to_string(most) + " bytes" : std::to_string(most >> 20U) + " MiB") +
                ", the limit for files of this type",
            where_);
    }
    std::string bytes(size(), '\0');
    if (read(0, bytes.data(), bytes.size()) != bytes.size()) {
        return fail(
            ErrorCode::BadInput,
            "the file cannot be read to its end; it was changed during reading, or the disk "
            "has errors",
            where_);
    }
    return bytes;
}

Result<InputFile> openNamedFile(const std::filesystem::path& path) {
    FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (!descriptor.valid()) {
        return fail(ErrorCode::BadInput,
                    errno == ENOENT
                        ? "there is no such file"
                        : std::string("the file cannot be opened (") + std::strerror(errno) + ")",
                    path.string());
    }
    Result<InputFile> file = InputFile::adopt(std::move(descriptor), path.string());
    if (file) InputRecord::note(InputUse::File, path, file->identity());
    return file;
}

Result<std::string> readNamedFile(const std::filesystem::path& path, std::uint64_t most) {
    const Result<InputFile> file = openNamedFile(path);
    if (!file) return tl::unexpected(file.error());
    return file->readAll(most);
}

}  // namespace dollytrack
