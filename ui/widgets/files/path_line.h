#pragma once

#include "ui/widgets/files/folder_reader.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// A line for typing a path, which offers what there is: Tab completes, a click takes.
class PathLine {
  public:
    explicit PathLine(std::function<void()> wake = {}) : reader_(std::move(wake)) {}

    /// Shows another path, unless the user is typing one.
    void show(const std::filesystem::path& path);
    void focus() { wants_focus_ = true; }
    /// Goes on with a path whose beginning was typed elsewhere.
    void typeOn(const std::string& begun);
    [[nodiscard]] bool isTyping() const { return typing_; }
    [[nodiscard]] const std::string& text() const { return text_; }

    /// Returns whether a path was entered: it is then text().
    bool draw(const FolderOrder& order, float width);

  private:
    void updateOffers(const FolderOrder& order);
    bool drawOffers(float left, float top, float width);
    void complete(std::string& text) const;

    std::string text_;
    bool typing_ = false;
    bool wants_focus_ = false;
    bool takes_over_ = false;  // letters are for this line, which has not the keyboard yet
    bool to_end_ = false;      // the cursor is to stand behind what is there
    bool escaped_ = false;     // the offers were sent away
    FolderReader reader_;
    std::string asked_folder_;  // of which the reader was asked
    std::shared_ptr<const FolderListing> listing_;
    std::vector<std::string> offers_;  // whole paths; those of folders end with a slash
    std::string offered_for_;
};

/// A path as typed, made absolute: "~" is the home folder, and what does not begin with a slash
/// lies in `folder`.
std::filesystem::path typedPath(const std::string& text, const std::filesystem::path& folder);

std::filesystem::path homeFolder();

}  // namespace dollytrack::ui
