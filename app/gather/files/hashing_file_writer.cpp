#include "app/gather/files/hashing_file_writer.h"

#include <fcntl.h>

#include <system_error>
#include <utility>

namespace dollytrack::gather {
namespace {

constexpr std::size_t kPending = std::size_t{4} << 20U;  // bytes

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
    if (hashing_.valid()) hashing_.get();
    hashed_->bytes.swap(pending_);
    pending_.clear();
    const auto hash = [hashed = hashed_.get()] {
        hashed->hash.add(std::string_view(hashed->bytes));
    };
    bool is_hashing = false;
    if (hashed_->bytes.size() >= kPending) {
        try {
            hashing_ = std::async(std::launch::async, hash);
            is_hashing = true;
        } catch (const std::system_error&) {  // no more threads can be started
        }
    }
    if (!is_hashing) hash();
    const int error = writeAll(file_.get(), hashed_->bytes);
    return error == 0 ? Status() : tl::unexpected(writeError(error, path_));
}

Result<std::string> HashingFileWriter::finish() {
    if (Status flushed = flush(); !flushed) return tl::unexpected(flushed.error());
    if (const int error = file_.close()) {
        return tl::unexpected(writeError(error, path_));
    }
    if (hashing_.valid()) hashing_.get();
    return hashed_->hash.finish();
}

}  // namespace dollytrack::gather
