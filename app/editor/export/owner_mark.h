#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dollytrack::editor {

/// The name under which this program leaves files in a folder that several share, on one computer
/// or on many: "host-1234-56789", with its process and when that began. A locked file of that name
/// says that it runs; the system gives the lock back however the program ends.
class OwnerMark {
  public:
    explicit OwnerMark(std::filesystem::path folder);
    ~OwnerMark();  // the lock's file goes
    OwnerMark(const OwnerMark&) = delete;
    OwnerMark& operator=(const OwnerMark&) = delete;

    [[nodiscard]] const std::string& text() const { return text_; }
    /// Makes the folder and takes the lock, unless it is held already. Call before each file is
    /// left: what was in the way at first may be gone. From one thread at a time.
    void hold();

    /// Whether the program of a mark in this folder still runs. Where locks do not work, a process
    /// of this computer is looked up, and one of another is taken to run.
    [[nodiscard]] static bool isHeld(const std::filesystem::path& folder, std::string_view mark);
    /// Removes the locks of programs that no longer run.
    static void tidy(const std::filesystem::path& folder);

  private:
    std::filesystem::path folder_;
    std::string text_;
    int lock_ = -1;
};

/// Held while one goes through what others left in a folder: of two programs that begin at once
/// one waits. Does nothing where locks do not work.
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
