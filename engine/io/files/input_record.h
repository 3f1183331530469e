#pragma once

#include "engine/io/files/input_file.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <vector>

namespace dollytrack {

/// One access of a reader to the file system.
struct InputUse {
    enum Kind : std::uint32_t {
        File,     // was opened
        Missing,  // was looked for but does not exist
        Listing,  // folder whose file names were listed
        Refused,  // lies outside the folders that may be read
    };
    Kind kind = File;
    std::filesystem::path path;
    FileIdentity identity;  // of a File

    bool operator<(const InputUse& other) const;
};

/// Collects the files that the reading of a scene depends on. While an object of this class exists,
/// accesses are noted in it; otherwise nowhere. Thread-safe.
class InputRecord {
  public:
    /// `opened` is called when a file is opened for the first time.
    explicit InputRecord(std::function<void(const FileIdentity&)> opened = {});
    ~InputRecord();
    InputRecord(const InputRecord&) = delete;
    InputRecord& operator=(const InputRecord&) = delete;

    /// The accesses so far, each once, ordered by kind and path.
    [[nodiscard]] std::vector<InputUse> uses() const;

    /// Notes an access in the record that exists, if any.
    static void note(InputUse::Kind kind, const std::filesystem::path& path,
                     const FileIdentity& identity = {});

  private:
    mutable std::mutex mutex_;
    std::set<InputUse> uses_;
    std::function<void(const FileIdentity&)> opened_;
};

}  // namespace dollytrack
