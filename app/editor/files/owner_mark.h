#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dollytrack::editor {

/// Identifies this process in a folder shared by several processes, on one or several computers:
/// "host-1234-56789" (host, process id, start time). A locked file of that name shows that the
/// process runs; the system releases the lock however the process ends.
class OwnerMark {
  public:
    explicit OwnerMark(std::filesystem::path folder);
    ~OwnerMark();  // removes the lock file
    OwnerMark(const OwnerMark&) = delete;
    OwnerMark& operator=(const OwnerMark&) = delete;

    [[nodiscard]] const std::string& text() const { return text_; }
    /// Creates the folder and takes the lock, unless it is held already. To be called before each
    /// file is written, because earlier attempts may have failed. One thread at a time.
    void hold();

    /// Whether the process that wrote a mark (its name of a process) in this folder still runs.
    /// Without working locks, a process of this computer is looked up, and one of another computer
    /// is assumed to run.
    [[nodiscard]] static bool isHeld(const std::filesystem::path& folder, std::string_view mark);
    /// Removes lock files of processes that no longer run.
    static void tidy(const std::filesystem::path& folder);

  private:
    std::filesystem::path folder_;
    std::string text_;
    int lock_ = -1;
};

/// Held while scanning a folder for files left by others: of two programs that start at once, one
/// waits. Does nothing if locks do not work.
class FolderLock {
  public:
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int lock_ = -1;
};

}  // namespace dollytrack::editor
