#include "app/gather/files/hashing_file_writer.h"

#include <fcntl.h>

#include <utility>

namespace dollytrack::gather {
namespace {

constexpr std::size_t kPending = std::size_t{1} << 20U;  // bytes

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
    pending_ += bytes;
    return pending_.size() < kPending ? Status() : flush();
}

Status HashingFileWriter::flush() {
    hash_.add(std::string_view(pending_));
    const int error = writeAll(file_.get(), pending_);
    pending_.clear();
    return error == 0 ? Status() : tl::unexpected(writeError(error, path_));
}

Result<std::string> HashingFileWriter::finish() {
    if (Status flushed = flush(); !flushed) return tl::unexpected(flushed.error());
    if (const int error = file_.close()) {
        return tl::unexpected(writeError(error, path_));
    }
    return hash_.finish();
}

}  // namespace dollytrack::gather
