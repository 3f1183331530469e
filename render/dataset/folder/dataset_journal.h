#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/plan/capture.h"
#include "render/dataset/folder/dataset_listing.h"
#include "render/frames/instances.h"
#include "render/frames/mask_rle.h"
#include "render/pictures/picture_quality.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// The inputs of a dataset by name, as values or hashes: {"the scene", "5ab0..."}. Frames of two
/// exports may be combined if their identities are equal.
using DatasetIdentity = std::map<std::string, std::string>;

/// Comma-separated names of the inputs in which two identities differ; empty if they are equal.
[[nodiscard]] std::string differences(const DatasetIdentity& a, const DatasetIdentity& b);

/// A finished frame: its files, and results that cannot be read back from them.
struct JournalEntry {
    int index = 0;
    std::map<std::string, std::string> sha256s;  // by path relative to the dataset folder
    std::vector<ObjectMask> masks;
    std::vector<InstanceInFrame> instances;
    std::vector<ObjectView> views;  // views that affect captures
    std::vector<int> well_shown;
    std::optional<PictureQuality> quality;  // of the colour image; none without modality rgb
};

/// File name of the journal in the dataset folder.
inline constexpr const char* kJournalFile = ".dollytrack-export";

/// Content of an earlier export's journal. Damaged and torn lines are ignored.
struct JournalContents {
    std::optional<DatasetIdentity> identity;  // none: nothing can be resumed
    std::string drawn_by;                     // name of the OpenGL driver
    DatasetNames names;                       // of the files that the export may have written
    std::map<int, JournalEntry> entries;      // by index
    std::uint64_t whole_bytes = 0;            // length without a torn last line
};
[[nodiscard]] JournalContents readJournal(const GuardedFolder& folder);

/// The list of finished frames, from which an export resumes: one line per frame, each with a
/// checksum. Lines are synced to disk every two seconds.
class DatasetJournal {
  public:
    /// Starts a new journal, overwriting an old one.
    [[nodiscard]] static Result<DatasetJournal> begin(const GuardedFolder& folder,
                                                      const DatasetIdentity& identity,
                                                      const std::string& drawn_by,
                                                      const DatasetNames& names);
    /// Continues the journal that readJournal() read.
    [[nodiscard]] static Result<DatasetJournal> resume(const GuardedFolder& folder,
                                                       const JournalContents& contents);

    /// A line that cannot be written completely is removed again.
    [[nodiscard]] Status append(const JournalEntry& entry);
    [[nodiscard]] Status sync();

  private:
    DatasetJournal(std::filesystem::path path, FileDescriptor file, std::uint64_t length);
    [[nodiscard]] static Result<DatasetJournal> open(const GuardedFolder& folder,
                                                     std::uint64_t length);
    [[nodiscard]] Status appendLine(const std::string& json);

    std::filesystem::path path_;
    FileDescriptor file_;
    std::uint64_t length_ = 0;
    std::chrono::steady_clock::time_point synced_;
};

}  // namespace dollytrack::render
