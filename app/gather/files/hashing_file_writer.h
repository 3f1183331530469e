#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_descriptor.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/sha256.h"

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace dollytrack::gather {

/// A new file that is written from its beginning to its end and hashed on the way. Errors are
/// CannotWrite.
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
    [[nodiscard]] Status writeHashed(std::string_view bytes);
    [[nodiscard]] Status flush();

    std::filesystem::path path_;
    FileDescriptor file_;
    Sha256 hash_;
    std::string pending_;  // not yet handed to the system
    std::uint64_t size_ = 0;
    off_t written_ = 0;  // handed to the system
    off_t to_disk_ = 0;  // the system was told to write to the disk
};

/// Opens a new file for writing. An existing file of that name is removed first, because an
/// interrupted run may have made it a hard link to an image of a dataset, which must not be
/// changed. Error: CannotWrite.
[[nodiscard]] Result<FileDescriptor> openNew(const GuardedFolder& folder, const std::string& name);

}  // namespace dollytrack::gather
