#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_descriptor.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace dollytrack {

/// Identifies a file and its content: equal as long as nobody wrote to the file or replaced it.
struct FileIdentity {
    std::uint64_t device = 0;
    std::uint64_t inode = 0;
    std::uint64_t size = 0;  // bytes
    std::int64_t modified_ns = 0;
    std::int64_t changed_ns = 0;
    auto operator<=>(const FileIdentity&) const = default;
};

/// A regular file open for reading; the destructor closes it.
class InputFile {
  public:
    /// Takes ownership of a descriptor. BadInput unless it is a regular file: a pipe could block
    /// for ever, a device may have no end.
    [[nodiscard]] static Result<InputFile> adopt(FileDescriptor file, const std::string& where);

    /// Reads up to `size` bytes from `offset`; fewer at the end of the file or after an error.
    [[nodiscard]] std::size_t read(std::uint64_t offset, void* into, std::size_t size) const;
    /// Reads the whole file. BadInput if it is larger than `most` bytes or cannot be read.
    [[nodiscard]] Result<std::string> readAll(std::uint64_t most) const;

    [[nodiscard]] const FileIdentity& identity() const { return identity_; }
    [[nodiscard]] std::uint64_t size() const { return identity_.size; }
    [[nodiscard]] int descriptor() const { return file_.get(); }

  private:
    InputFile(FileDescriptor file, FileIdentity identity, std::string where)
        : file_(std::move(file)), identity_(identity), where_(std::move(where)) {}

    FileDescriptor file_;
    FileIdentity identity_;
    std::string where_;
};

/// Opens a file that the user named. Links are followed wherever they lead; a pipe or device is
/// refused without blocking. Noted in the InputRecord. Error: BadInput.
[[nodiscard]] Result<InputFile> openNamedFile(const std::filesystem::path& path);

/// Reads the whole of such a file. Errors: BadInput.
[[nodiscard]] Result<std::string> readNamedFile(const std::filesystem::path& path,
                                                std::uint64_t most);

}  // namespace dollytrack
