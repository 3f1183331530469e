#pragma once

#include "engine/io/sandbox/input_file.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <vector>

namespace dollytrack::io {

/// One thing that a reader asked the file system.
struct InputUse {
    enum Kind : std::uint32_t {
        File,     // it was opened
        Missing,  // it was looked for, and is not there
        Listing,  // a folder, for the names of the files beneath it
        Refused,  // it lies outside
    };
    Kind kind = File;
    std::filesystem::path path;
    FileIdentity identity;  // of a File

    bool operator<(const InputUse& other) const;
};

/// What a reading depends on. The program that reads one scene keeps one; elsewhere nothing is
/// noted. Any thread may note.
class InputRecord {
  public:
    /// `opened` hears of each file when it is opened for the first time.
    explicit InputRecord(std::function<void(const FileIdentity&)> opened = {});
    ~InputRecord();
    InputRecord(const InputRecord&) = delete;
    InputRecord& operator=(const InputRecord&) = delete;

    /// What was asked so far, each once, in the order of kind and path.
    [[nodiscard]] std::vector<InputUse> uses() const;

    /// Notes it in the record that is alive, if one is.
    static void note(InputUse::Kind kind, const std::filesystem::path& path,
                     const FileIdentity& identity = {});

  private:
    mutable std::mutex mutex_;
    std::set<InputUse> uses_;
    std::function<void(const FileIdentity&)> opened_;
};

}  // namespace dollytrack::io
