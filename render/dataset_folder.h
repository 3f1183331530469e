#pragma once

#include "engine/core/result.h"
#include "engine/io/file_descriptor.h"
#include "render/formats/formats.h"
#include "render/modalities.h"

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace dollytrack::render {

/// An output folder held by one export. While it is held, and after an export that did not end, the
/// journal in it marks it as ours; the journal's file is also the lock.
class DatasetFolder {
  public:
    /// Makes the folder where there is none, and locks it. What is in it stays as it is.
    /// CannotWrite when it cannot be written, when another export holds it, and when it holds
    /// anything but neither a dataset.json of ours nor our mark, unless `overwrite`.
    [[nodiscard]] static Result<DatasetFolder> claim(const std::filesystem::path& folder,
                                                     bool overwrite);
    /// Gives the lock back, and takes the mark and an empty folder away if nothing was begun.
    ~DatasetFolder();
    DatasetFolder(DatasetFolder&&) = default;
    DatasetFolder& operator=(DatasetFolder&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
    [[nodiscard]] std::filesystem::path journal() const;

    /// Whether a dataset.json of ours stands in it: the dataset is complete.
    [[nodiscard]] bool isComplete() const;

    /// Usage when a complete dataset stands in it: it is not replaced unasked. Says what it is.
    [[nodiscard]] Status checkNotComplete() const;

    /// Whether the folder is what claim() locked: nobody has taken it away.
    [[nodiscard]] bool isThere() const;

    /// Whether `bytes` more fit on the disk once begin() has removed what is not kept.
    [[nodiscard]] Status checkSpace(std::uint64_t bytes, const std::set<std::string>& keep) const;

    /// From here on the folder belongs to the new dataset: removes what an earlier one left,
    /// dataset.json first, but for the frames' files in `keep` (relative paths), and makes the
    /// subfolders, `more` (relative paths) among them. Only files named like a dataset's are
    /// removed.
    [[nodiscard]] Status begin(const ModalitySet& modalities, const FormatSet& formats,
                               const std::set<std::string>& keep,
                               const std::vector<std::string>& more = {});

    /// Removes the journal: the dataset is complete. Call last.
    [[nodiscard]] Status release();

  private:
    DatasetFolder() = default;

    std::filesystem::path folder_;
    io::FileDescriptor lock_;  // the journal
    // What claim() did, so that an early end can undo it.
    bool made_ = false;
    bool marked_ = false;
};

}  // namespace dollytrack::render
