#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_descriptor.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/sha256.h"

#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <string_view>

namespace dollytrack::gather {

/// A new file that is written from its beginning to its end and hashed on the way, on a thread of
/// its own while the bytes go to the disk. Errors are CannotWrite.
class HashingFileWriter {
  public:
    /// Creates the file; an existing one of this name is removed at once.
    [[nodiscard]] static Result<HashingFileWriter> create(const GuardedFolder& folder,
                                                          const std::string& name);

    [[nodiscard]] Status write(std::string_view bytes);
    /// Bytes written so far.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Closes the file; returns its SHA-256.
    [[nodiscard]] Result<std::string> finish();

  private:
    HashingFileWriter(std::filesystem::path path, FileDescriptor file)
        : path_(std::move(path)), file_(std::move(file)) {}
    [[nodiscard]] Status flush();

    /// The hashing thread's data; its address stays the same when the writer is moved.
    struct Hashed {
        Sha256 hash;
        std::string bytes;  // handed to the system
    };

    std::filesystem::path path_;
    FileDescriptor file_;
    std::unique_ptr<Hashed> hashed_ = std::make_unique<Hashed>();
    std::future<void> hashing_;  // destroyed first, because that waits for the thread
    std::string pending_;        // not yet handed to the system
    std::uint64_t size_ = 0;
};

/// Opens a new file for writing. An existing file of that name is removed first, because an
/// interrupted run may have made it a hard link to an image of a dataset, which must not be
/// changed. Error: CannotWrite.
[[nodiscard]] Result<FileDescriptor> openNew(const GuardedFolder& folder, const std::string& name);

}  // namespace dollytrack::gather
