#include "app/gather/files/hashing_file_writer.h"

#include <fcntl.h>

#include <utility>

namespace dollytrack::gather {
namespace {

// Bytes.
constexpr std::size_t kPending = std::size_t{1} << 20U;  // smaller pieces are collected up to this
constexpr std::size_t kLarge = std::size_t{1} << 16U;    // pieces from this size are not collected
constexpr off_t kWriteback = off_t{16} << 20U;

}  // namespace

Result<FileDescriptor> openNew(const GuardedFolder& folder, const std::string& name) {
    constexpr int kNew = O_WRONLY | O_CREAT | O_EXCL;
    Result<FileDescriptor> file = folder.openFile(name, kNew);
    if (file || !folder.has(name)) return file;
    if (Status removed = folder.remove(name); !removed) return tl::unexpected(removed.error());
    return folder.openFile(name, kNew);
}

Result<HashingFileWriter> HashingFileWriter::create(const GuardedFolder& folder,
                                                    const std::string& name) {
    Result<FileDescriptor> file = openNew(folder, name);
    if (!file) return tl::unexpected(file.error());
    return HashingFileWriter(folder.path() / name, std::move(*file));
}

Status HashingFileWriter::write(std::string_view bytes) {
    size_ += bytes.size();
    if (bytes.size() >= kLarge) {
        if (Status flushed = flush(); !flushed) return flushed;
        return writeHashed(bytes);
    }
    pending_ += bytes;
    return pending_.size() < kPending ? Status() : flush();
}

Status HashingFileWriter::writeHashed(std::string_view bytes) {
    hash_.add(bytes);
    if (const int error = writeAll(file_.get(), bytes)) {
        return tl::unexpected(writeError(error, path_));
    }
    written_ += static_cast<off_t>(bytes.size());
    if (written_ - to_disk_ >= kWriteback) {
        // Only a hint: otherwise the sync at the end of the dataset waits for most of the bytes.
        ::sync_file_range(file_.get(), to_disk_, written_ - to_disk_, SYNC_FILE_RANGE_WRITE);
        to_disk_ = written_;
    }
    return {};
}

Status HashingFileWriter::flush() {
    Status written = writeHashed(pending_);
    pending_.clear();
    return written;
}

Result<std::string> HashingFileWriter::finish() {
    if (Status flushed = flush(); !flushed) return tl::unexpected(flushed.error());
    if (const int error = file_.close()) {
        return tl::unexpected(writeError(error, path_));
    }
    return hash_.finish();
}

}  // namespace dollytrack::gather
