#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/dataset_listing.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dollytrack::render {

/// An output folder held by one export. While it is held, and after an export that did not end, the
/// journal in it marks it as ours; the journal's file is also the lock.
///
/// Where no complete dataset stands in the folder, the new one is written into it. Beside a
/// complete dataset the new one is written into a folder of its own within it (`.dollytrack-new`)
/// and takes the old one's place in finish(), so that an export that does not end leaves the old
/// one whole. What takes the place is decided by one rename; if the rest is cut off, the next
/// claim() of the folder ends it.
class DatasetFolder {
  public:
    /// Makes the folder where there is none, and locks it. What is in it stays as it is. Links
    /// below `root`, a folder around it, are not followed; empty: its whole path is the user's.
    /// CannotWrite when it cannot be written, when another export holds it, and when it holds
    /// anything but neither a dataset.json of ours nor our mark, unless `overwrite`.
    [[nodiscard]] static Result<DatasetFolder> claim(const std::filesystem::path& folder,
                                                     bool overwrite,
                                                     const std::filesystem::path& root = {});
    /// Gives the lock back. If no journal was begun, removes the mark and the folders that claim()
    /// and begin() made, as far as they are empty.
    ~DatasetFolder();
    DatasetFolder(DatasetFolder&&) = default;
    DatasetFolder& operator=(DatasetFolder&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
    /// The folder itself, which has the journal.
    [[nodiscard]] const io::GuardedFolder& folder() const { return folder_; }
    /// Where the files of an unfinished dataset are: the folder itself, or the one for a new
    /// dataset beside a complete one.
    [[nodiscard]] const io::GuardedFolder& unfinished() const {
        return staged_ ? *staged_ : folder_;
    }

    /// Whether a dataset.json of ours stands in it: the dataset is complete.
    [[nodiscard]] bool isComplete() const { return complete_; }
    /// Whether an unfinished dataset lies beside a complete one.
    [[nodiscard]] bool isStaged() const { return staged_.has_value(); }

    /// Usage when a complete dataset stands in it: it is not replaced unasked. Says what it is.
    [[nodiscard]] Status checkNotComplete() const;

    /// Whether the folder is what claim() locked: nobody has taken it away.
    [[nodiscard]] bool isThere() const;

    /// Whether `bytes` more fit on the disk once begin() has removed what is not kept. A complete
    /// dataset stays until the new one is complete, and gives no space back before.
    [[nodiscard]] Status checkSpace(std::uint64_t bytes, const std::set<std::string>& keep) const;

    /// Removes what an unfinished dataset left, by the names that its journal lists, but for the
    /// frames' files in `keep` (relative paths), and makes the folders of the new one, which may
    /// write `names`. Error: CannotWrite, also for a link where a folder of the dataset should be.
    [[nodiscard]] Status begin(const DatasetNames& names, const std::set<std::string>& keep);

    /// The dataset in unfinished() is complete, its dataset.json on the disk: takes the place of an
    /// earlier one, whose files are removed if its dataset.json lists them, and removes the
    /// journal.
    [[nodiscard]] Status finish();

    /// Nothing is to be done in the folder: removes the journal and what lies beside the dataset.
    [[nodiscard]] Status release();

  private:
    explicit DatasetFolder(io::GuardedFolder folder) : folder_(std::move(folder)) {}
    [[nodiscard]] Result<std::vector<std::string>> leftFiles(
        const std::set<std::string>& keep) const;
    /// Whether the new dataset is the one that counts, but not all of it has moved.
    [[nodiscard]] bool isMoving() const;
    /// Whether the journal has its first line: from then on the export can be continued.
    [[nodiscard]] bool isBegun() const;
    [[nodiscard]] Status moveIntoPlace();
    [[nodiscard]] Status removeStaged();

    io::GuardedFolder folder_;
    std::optional<io::GuardedFolder> staged_;
    io::FileDescriptor lock_;  // the journal
    // What was made, so that an early end can remove it.
    bool marked_ = false;
    // Folders that did not exist before claim(), innermost first.
    std::vector<std::filesystem::path> made_around_;
    bool made_staged_ = false;
    std::vector<std::string> made_within_;  // in unfinished(), outer folders first
    bool complete_ = false;
};

}  // namespace dollytrack::render
