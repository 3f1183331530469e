#pragma once

#include "engine/core/result.h"
#include "engine/io/files/file_descriptor.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace dollytrack::io {

/// Which file it is, and which state of it: equal as long as nobody wrote to it or replaced it.
struct FileIdentity {
    std::uint64_t device = 0;
    std::uint64_t inode = 0;
    std::uint64_t size = 0;  // bytes
    std::int64_t modified_ns = 0;
    std::int64_t changed_ns = 0;
    auto operator<=>(const FileIdentity&) const = default;
};

/// A regular file that is open for reading; closed with this object.
class InputFile {
  public:
    /// Takes over a descriptor. BadInput when it is no regular file: a pipe would block for ever,
    /// a device has no end.
    [[nodiscard]] static Result<InputFile> adopt(FileDescriptor file, const std::string& where);

    /// Up to `size` bytes from `offset` on; fewer at the end of the file and after an error.
    [[nodiscard]] std::size_t read(std::uint64_t offset, void* into, std::size_t size) const;
    /// All of it. BadInput when it is larger than `most` bytes or cannot be read.
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

/// Opens a file for reading, as all programs do: links are followed, wherever they lead; a pipe or
/// device is refused, never waited for. Noted in the InputRecord. Error: BadInput.
[[nodiscard]] Result<InputFile> openNamedFile(const std::filesystem::path& path);

/// All of such a file. Errors: BadInput.
[[nodiscard]] Result<std::string> readNamedFile(const std::filesystem::path& path,
                                                std::uint64_t most);

}  // namespace dollytrack::io
