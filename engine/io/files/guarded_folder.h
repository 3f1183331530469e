#pragma once

#include "engine/core/result.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/file_descriptor.h"
#include "engine/io/files/input_file.h"

#include <sys/stat.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// writeWhole() in an open folder, on which it is built; 0 or errno.
[[nodiscard]] int writeWholeAt(int folder, const std::string& name,
                               std::span<const std::uint8_t> bytes, Durability durability);

/// A folder that is held open, and the one way in which files of datasets, batches and caches are
/// opened, written, renamed and removed. Names are paths relative to it. Each step from the folder
/// to a file is taken relative to the step before, and none follows a symbolic link, so nothing
/// outside is ever touched, whatever other programs change meanwhile. A name that is absolute or
/// has ".." in it is refused. Errors are CannotWrite and name the file, or the link in the way.
class GuardedFolder {
  public:
    /// Links on the way to the folder itself are followed: its path is the user's.
    [[nodiscard]] static Result<GuardedFolder> open(const std::filesystem::path& folder);
    /// The same; makes the folder, and those around it, where they are missing.
    [[nodiscard]] static Result<GuardedFolder> make(const std::filesystem::path& folder);
    /// The same, but no link below `root`, a folder around it or itself, is followed; an empty root
    /// is the folder itself.
    [[nodiscard]] static Result<GuardedFolder> makeBelow(const std::filesystem::path& folder,
                                                         const std::filesystem::path& root);

    /// A folder within this one, reached without following links; makes what is missing.
    [[nodiscard]] Result<GuardedFolder> makeWithin(const std::string& name) const;
    [[nodiscard]] Result<GuardedFolder> openWithin(const std::string& name) const;

    /// The path of the folder, for messages and for programs that take only paths.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Whether a name is relative, without "..", "." and empty parts.
    [[nodiscard]] static bool isPlain(std::string_view name);

    /// A regular file; `flags` as for open(2), of which O_TRUNC is left out. For writing, a file
    /// that has a second name (a hard link) is refused: the other name may lie anywhere.
    [[nodiscard]] Result<FileDescriptor> openFile(const std::string& name, int flags) const;
    /// Opens a file for writing and empties it.
    [[nodiscard]] Result<FileDescriptor> openEmptied(const std::string& name) const;
    using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
    /// A regular file for reading; null when it cannot be opened.
    [[nodiscard]] Stream openStream(const std::string& name) const;
    /// A regular file for reading with a limit of size.
    [[nodiscard]] Result<InputFile> openInput(const std::string& name) const;
    /// All of a regular file; nothing when it cannot be read to its end.
    [[nodiscard]] std::optional<std::vector<std::uint8_t>> read(const std::string& name) const;

    /// What has this name, a link itself included; nothing where there is nothing.
    [[nodiscard]] std::optional<struct stat> find(const std::string& name) const;
    [[nodiscard]] bool has(const std::string& name) const { return find(name).has_value(); }
    /// The names in a folder within this one ("" is this one), in order; none where it is missing.
    [[nodiscard]] Result<std::vector<std::string>> list(const std::string& name) const;
    /// Whether no link and no file stands where this folder and those around it should be.
    [[nodiscard]] Status checkFolder(const std::string& name) const;
    /// Whether no link and no folder stands where this file should be.
    [[nodiscard]] Status checkFile(const std::string& name) const;

    /// As writeWhole(); folders within this one that the name needs are made.
    [[nodiscard]] Status write(const std::string& name, std::span<const std::uint8_t> bytes,
                               Durability durability = Durability::Synced) const;
    [[nodiscard]] Status write(const std::string& name, std::string_view text,
                               Durability durability = Durability::Synced) const;
    /// Gives a file another name in this or another folder of the same file system; what has that
    /// name is replaced. Folders within `to` that it needs are made. False where there is no such
    /// file.
    [[nodiscard]] Result<bool> move(const std::string& name, const GuardedFolder& to,
                                    const std::string& new_name) const;
    /// Gives a file a second name within this folder (a hard link), in the place of the file that
    /// has that name; a copy where the file system has no hard links. Folders are made.
    [[nodiscard]] Status link(const std::string& name, const std::string& new_name) const;
    /// Removes a file; of a symbolic link, the link itself. Does nothing if there is no such file.
    [[nodiscard]] Status remove(const std::string& name) const;
    /// Removes a folder if it is empty, then its parent folders as far as they have become empty.
    void removeEmpty(const std::string& name) const;

    /// Flushes the folder's entries to the disk.
    [[nodiscard]] Status syncNames() const;
    /// Brings everything written so far on the folder's file system to the disk.
    [[nodiscard]] Status syncAll() const;
    /// The bytes that can still be written there; nothing where that cannot be said.
    [[nodiscard]] std::optional<std::uint64_t> freeBytes() const;

  private:
    struct Place;
    GuardedFolder(std::filesystem::path path, FileDescriptor folder);
    [[nodiscard]] Result<Place> placeOf(const std::string& name, bool make) const;
    [[nodiscard]] Result<GuardedFolder> within(const std::string& name, bool make) const;
    /// Nothing where a folder on the way is missing.
    [[nodiscard]] Result<std::optional<Place>> findPlace(const std::string& name, bool make) const;
    int walk(const std::string& name, bool make, Place& place) const;
    [[nodiscard]] tl::unexpected<Error> failure(int error, const Place& at) const;

    std::filesystem::path path_;
    std::shared_ptr<const FileDescriptor> folder_;
};

}  // namespace dollytrack
