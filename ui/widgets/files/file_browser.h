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
    std::vector<std::string> extensions;  // such as ".glb", in lower case; empty: all files
};

/// A request to choose a file or folder.
struct FileRequest {
    enum class Purpose { Open, Save, ChooseFolder };
    Purpose purpose = Purpose::Open;
    std::string id;                   // returned with the answer
    std::string title;                // window title, "Open a scene or a project"
    std::string accept = "Open";      // label of the confirming button
    std::vector<FileFilter> filters;  // the first is active initially; "All files" is appended
    std::filesystem::path start;      // initial folder or file; empty: current folder
    std::string name;                 // Save: proposed name
    std::string extension;            // Save: appended to names without it, such as ".dolly"
    std::vector<std::filesystem::path> recent_folders;  // newest first
};

struct FileAnswer {
    std::string id;
    std::filesystem::path path;  // absolute
};

/// A modal dialog for choosing a file or a folder. All disk access runs on background threads.
class FileBrowser {
  public:
    /// `wake` is called from a background thread when there is something new to show.
    explicit FileBrowser(std::function<void()> wake = {});
    ~FileBrowser();
    FileBrowser(const FileBrowser&) = delete;
    FileBrowser& operator=(const FileBrowser&) = delete;

    void ask(FileRequest request);
    [[nodiscard]] bool isOpen() const;
    /// Draws the dialog if it is open; to be called every frame. Returns the answer once;
    /// cancelling gives none.
    [[nodiscard]] std::optional<FileAnswer> draw();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::ui
