#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

struct FileFilter {
    std::string name;                     // "Scenes and projects"
    std::vector<std::string> extensions;  // ".glb", in lower case; empty: all files
};

/// What the user shall choose.
struct FileRequest {
    enum class Purpose { Open, Save, ChooseFolder };
    Purpose purpose = Purpose::Open;
    std::string id;                   // comes back with the answer
    std::string title;                // "Open a scene or a project"
    std::string accept = "Open";      // text of the button
    std::vector<FileFilter> filters;  // the first is chosen; "All files" is added
    std::filesystem::path start;      // a folder to begin in, or a file to begin at
    std::string name;                 // to save: a proposal
    std::string extension;            // to save: every name gets it that has it not, ".dolly"
    std::vector<std::filesystem::path> recent_folders;  // newest first
};

struct FileAnswer {
    std::string id;
    std::filesystem::path path;  // absolute
};

/// A dialog over the window for choosing a file or a folder. Never waits for the disk.
class FileBrowser {
  public:
    /// `wake` is called from another thread when there is something new to show.
    explicit FileBrowser(std::function<void()> wake = {});
    ~FileBrowser();
    FileBrowser(const FileBrowser&) = delete;
    FileBrowser& operator=(const FileBrowser&) = delete;

    void ask(FileRequest request);
    [[nodiscard]] bool isOpen() const;
    /// Once a frame. The answer comes once; cancelling gives none.
    [[nodiscard]] std::optional<FileAnswer> draw();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::ui
