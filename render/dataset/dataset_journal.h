#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/plan/capture.h"
#include "render/dataset/dataset_listing.h"
#include "render/dataset/picture_quality.h"
#include "render/formats/labels/mask_rle.h"
#include "render/frames/instances.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// What a dataset is made from, in words and hashes: {"the scene", "5ab0..."}. Frames of two
/// exports belong together when these are equal.
using DatasetIdentity = std::map<std::string, std::string>;

/// The names of what two identities do not share, for a sentence; empty when they are equal.
[[nodiscard]] std::string differences(const DatasetIdentity& a, const DatasetIdentity& b);

/// A finished frame: its files, and what cannot be read from them again.
struct JournalEntry {
    int index = 0;
    std::map<std::string, std::string> sha256s;  // by relative path
    std::vector<ObjectMask> masks;
    std::vector<InstanceInFrame> instances;
    std::vector<ObjectView> views;  // those that decide about captures
    std::vector<int> well_shown;
    std::optional<PictureQuality> quality;  // of the picture; none without a modality rgb
};

/// The journal's file in a dataset's folder.
inline constexpr const char* kJournalFile = ".dollytrack-export";

/// What an earlier export left. Damaged and torn lines are as if never written.
struct JournalContents {
    std::optional<DatasetIdentity> identity;  // none: nothing that could be continued
    std::string drawn_by;                     // the OpenGL driver
    DatasetNames names;                       // of the files that it may have left
    std::map<int, JournalEntry> entries;      // by index
    std::uint64_t whole_bytes = 0;            // up to where a torn last line begins
};
[[nodiscard]] JournalContents readJournal(const io::GuardedFolder& folder);

/// The list of finished frames that lets an export continue: a line a frame, each with a checksum.
/// Lines are brought to the disk every few seconds.
class DatasetJournal {
  public:
    /// Writes over what is there.
    [[nodiscard]] static Result<DatasetJournal> begin(const io::GuardedFolder& folder,
                                                      const DatasetIdentity& identity,
                                                      const std::string& drawn_by,
                                                      const DatasetNames& names);
    /// Writes behind what readJournal() found.
    [[nodiscard]] static Result<DatasetJournal> resume(const io::GuardedFolder& folder,
                                                       const JournalContents& contents);

    /// A line that does not fit on the disk leaves nothing behind.
    [[nodiscard]] Status append(const JournalEntry& entry);
    [[nodiscard]] Status sync();

  private:
    DatasetJournal(std::filesystem::path path, io::FileDescriptor file, std::uint64_t length);
    [[nodiscard]] static Result<DatasetJournal> open(const io::GuardedFolder& folder,
                                                     std::uint64_t length);
    [[nodiscard]] Status appendLine(const std::string& json);

    std::filesystem::path path_;
    io::FileDescriptor file_;
    std::uint64_t length_ = 0;
    std::chrono::steady_clock::time_point synced_;
};

}  // namespace dollytrack::render
