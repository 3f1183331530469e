#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/folder/dataset_journal.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::gather {

/// The list of all files of the gathered dataset, except gather.json, with their hashes, as
/// sha256sum reads it.
inline constexpr const char* kSumsFile = "SHA256SUMS";

/// What gather.json calls itself, under `format`.
inline constexpr const char* kGatherFormat = "dollytrack gather";

/// A shard, a tar, Parquet, MCAP or bag file, that an earlier run finished.
struct FinishedShard {
    std::string name;
    std::size_t frames = 0;
    std::string sha256;
};

/// An output folder held by one gathering. All is written into a folder within it
/// (`.dollytrack-new`) and takes its place in finish(), so that what is not complete is never taken
/// for a dataset, and an earlier one stays whole until then. What decides is one rename; if the
/// rest is cut off, the next claim() ends it. Nothing follows a symbolic link.
class OutputFolder {
  public:
    /// Makes the folder where there is none, and locks it. CannotWrite when it cannot be written,
    /// when another program holds it, when a symbolic link is in it, and when it holds files but no
    /// gathered dataset, unless `overwrite`; or an exported dataset in any case.
    [[nodiscard]] static Result<OutputFolder> claim(const std::filesystem::path& folder,
                                                    bool overwrite);
    /// Gives the lock back; removes what claim() made if nothing was begun.
    ~OutputFolder();
    OutputFolder(OutputFolder&&) = default;
    OutputFolder& operator=(OutputFolder&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
    [[nodiscard]] const GuardedFolder& folder() const { return folder_; }
    /// Where the new dataset is written; after begin().
    [[nodiscard]] const GuardedFolder& staged() const { return *staged_; }
    /// Whether a complete gathered dataset is in the folder.
    [[nodiscard]] bool isComplete() const { return complete_; }

    /// Begins a dataset. With `resume` what an earlier run left of the same one stays, and its
    /// finished shards are returned. Errors: Usage where that is of something else, saying what
    /// differs; CannotWrite.
    [[nodiscard]] Result<std::vector<FinishedShard>> begin(const render::DatasetIdentity& identity,
                                                           bool resume);
    /// Notes a shard that need not be written again.
    [[nodiscard]] Status note(const FinishedShard& shard);

    /// The dataset in staged() is complete, its gather.json on the disk: takes the place of an
    /// earlier one, whose files are removed if its list has them. Other files stay.
    [[nodiscard]] Status finish();

  private:
    explicit OutputFolder(GuardedFolder folder) : folder_(std::move(folder)) {}
    [[nodiscard]] Status checkContents(bool overwrite) const;
    [[nodiscard]] Status appendLine(const std::string& json);
    [[nodiscard]] Status moveIntoPlace();
    [[nodiscard]] Status removeListed();
    [[nodiscard]] Status removeStaged();

    GuardedFolder folder_;
    std::optional<GuardedFolder> staged_;
    FileDescriptor lock_;     // of the journal
    bool is_marked_ = false;  // by an earlier run, or begin()
    bool made_ = false;       // the folder itself
    bool complete_ = false;
};

/// Calls `take(sha256, name)` for each line of a list as sha256sum writes it, until one returns an
/// error. Lines of another form are passed by. Error also: CannotWrite where it cannot be read.
[[nodiscard]] Status forEachSum(
    const GuardedFolder& folder, const std::string& list,
    const std::function<Status(std::string_view sha256, const std::string& name)>& take);

}  // namespace dollytrack::gather
