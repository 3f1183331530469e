#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// Files by name, in a folder or inside an archive. Names are relative, with slashes; one that
/// leaves the folder is not there.
class FileSource {
  public:
    virtual ~FileSource() = default;
    /// The whole file, nothing when there is none; an Error when it is there but cannot be taken
    /// (damaged, encrypted, too large).
    [[nodiscard]] virtual Result<std::optional<std::vector<std::uint8_t>>> read(
        const std::string& name) const = 0;
};

/// One that knows what it holds.
class Archive : public FileSource {
  public:
    /// Every file's name, sorted.
    [[nodiscard]] virtual std::vector<std::string> names() const = 0;
};

/// "a/./b\c" as "a/b/c"; nothing for a name that is absolute, leaves its folder or is empty.
std::optional<std::string> safeRelativeName(const std::string& name);

/// The files below a folder; links that lead out of it are not there.
std::unique_ptr<FileSource> openFolder(const std::filesystem::path& folder);

/// The files of a zip archive (.sh3d, .sh3f, .zip, .jar). Refused with BadInput: names that leave
/// the archive, encrypted entries, more than 100,000 entries, an entry over 512 MiB and archives
/// over 4 GiB unpacked. Entries are unpacked one by one, when read, and never beyond the size that
/// the archive declares.
Result<std::unique_ptr<Archive>> openArchive(const std::filesystem::path& path);

/// The same over bytes already read, which are kept; `where` names them in errors.
Result<std::unique_ptr<Archive>> openArchive(std::vector<std::uint8_t> bytes,
                                             const std::string& where);

}  // namespace dollytrack
