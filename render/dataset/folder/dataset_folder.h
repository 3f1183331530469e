#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/folder/dataset_listing.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dollytrack::render {

/// An output folder locked by one export. During an export, and after one that did not finish, the
/// journal marks the folder as Dollytrack's; the journal file is also the lock.
///
/// Without a complete dataset in the folder, the new one is written directly into it. Otherwise it
/// is written into a subfolder (`.dollytrack-new`) and replaces the old one in finish(), so that an
/// unfinished export leaves the old dataset intact. A single rename decides which dataset is valid;
/// if moving the files is interrupted, the next claim() completes it.
class DatasetFolder {
  public:
    /// Creates the folder if necessary and locks it; its content is unchanged. Symbolic links below
    /// `root`, a parent folder, are not followed; an empty `root` trusts the whole path. Returns
    /// CannotWrite if the folder cannot be written, if another export holds it, or if it contains
    /// files but neither a dataset.json of Dollytrack nor its mark and `overwrite` is false.
    [[nodiscard]] static Result<DatasetFolder> claim(const std::filesystem::path& folder,
                                                     bool overwrite,
                                                     const std::filesystem::path& root = {});
    /// Releases the lock. Unless makeFolders() succeeded, also removes the mark and the empty
    /// folders that this object created.
    ~DatasetFolder();
    DatasetFolder(DatasetFolder&&) = default;
    DatasetFolder& operator=(DatasetFolder&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
    /// The folder itself, which contains the journal.
    [[nodiscard]] const GuardedFolder& folder() const { return folder_; }
    /// Folder of the unfinished dataset's files: the folder itself, or the subfolder beside a
    /// complete dataset.
    [[nodiscard]] const GuardedFolder& unfinished() const { return staged_ ? *staged_ : folder_; }

    /// Whether the folder contains a dataset.json of Dollytrack, which means a complete dataset.
    [[nodiscard]] bool isComplete() const { return complete_; }
    /// Whether an unfinished dataset lies beside a complete one.
    [[nodiscard]] bool isStaged() const { return staged_.has_value(); }

    /// Returns Usage, describing the dataset, if the folder contains a complete one.
    [[nodiscard]] Status checkNotComplete() const;

    /// Whether the folder on disk is still the one that claim() locked.
    [[nodiscard]] bool isThere() const;

    /// Checks that `bytes` more fit on the disk after begin() has removed files not in `keep`. A
    /// complete dataset stays until the new one is complete, so its space does not count. Returns
    /// CannotWrite if the space does not suffice.
    [[nodiscard]] Status checkSpace(std::uint64_t bytes, const std::set<std::string>& keep) const;

    /// Removes the files of an unfinished dataset, by the names in its journal, except frame files
    /// in `keep` (relative paths), and chooses unfinished() for the new one, which may write
    /// `names`. Returns CannotWrite if that fails or a symbolic link is in the way.
    [[nodiscard]] Status begin(const DatasetNames& names, const std::set<std::string>& keep);

    /// Creates the folders of the new dataset. The journal's first line must be written: without
    /// it, the folders of an export that was killed would look like another program's. Returns
    /// Failed if the journal is empty, CannotWrite if a folder cannot be created.
    [[nodiscard]] Status makeFolders(const DatasetNames& names);

    /// Makes the dataset in unfinished() the valid one; its dataset.json must be on disk. Removes
    /// those files of an earlier dataset that its dataset.json lists, moves the new files into
    /// place, and removes the journal.
    [[nodiscard]] Status finish();

    /// Ends without changes: removes the journal and any unfinished dataset beside a complete one.
    [[nodiscard]] Status release();

  private:
    explicit DatasetFolder(GuardedFolder folder) : folder_(std::move(folder)) {}
    [[nodiscard]] Result<std::vector<std::string>> leftFiles(
        const std::set<std::string>& keep) const;
    /// Whether the new dataset is already the valid one but not completely moved.
    [[nodiscard]] bool isMoving() const;
    [[nodiscard]] Status moveIntoPlace();
    [[nodiscard]] Status removeStaged();

    GuardedFolder folder_;
    std::optional<GuardedFolder> staged_;
    FileDescriptor lock_;  // the journal
    bool begun_ = false;   // all folders were created
    // Created folders and marks, removed if the export ends early.
    bool marked_ = false;
    // Parent folders that claim() created, innermost first.
    std::vector<std::filesystem::path> made_around_;
    bool made_staged_ = false;
    std::vector<std::string> made_within_;  // in unfinished(), parents first
    bool complete_ = false;
};

}  // namespace dollytrack::render
