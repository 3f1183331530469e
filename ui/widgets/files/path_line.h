#pragma once

#include "ui/widgets/files/folder_reader.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// A text field for a path with suggestions: Tab completes; Up, Down and Enter or a click choose;
/// Esc closes the list.
class PathLine {
  public:
    explicit PathLine(std::function<void()> wake = {}) : reader_(std::move(wake)) {}

    /// Sets the displayed path, unless the user is typing.
    void show(const std::filesystem::path& path);
    void focus() { wants_focus_ = true; }
    /// Continues a path whose beginning was typed outside the field.
    void typeOn(const std::string& begun);
    [[nodiscard]] bool isTyping() const { return typing_; }
    [[nodiscard]] const std::string& text() const { return text_; }

    /// Returns whether a path was entered; text() then returns it.
    bool draw(const FolderOrder& order, float width);

  private:
    void updateOffers(const FolderOrder& order);
    bool drawOffers(float left, float top, float width);
    void complete(std::string& text) const;
    [[nodiscard]] bool isListOpen() const { return !suggestions_hidden_ && !offers_.empty(); }
    /// Returns the suggestion chosen with the keys, and clears the choice; empty: none was chosen.
    std::string takeChosen();
    /// Moves the choice down by some rows (negative: up), around the ends of the list.
    void moveChoice(int rows);
    /// Draws the text field; returns whether Enter was pressed.
    bool drawField(float width);
    /// Makes a suggestion the text; after a folder, typing goes on.
    void take(const std::string& offer);
    /// Gives the keyboard back to the field, with the cursor at the end and the list closed.
    void continueTyping();

    std::string text_;
    bool typing_ = false;
    bool wants_focus_ = false;
    bool takes_over_ = false;  // typed letters are kept for this field until it has the keyboard
    bool to_end_ = false;      // move the cursor to the end
    bool suggestions_hidden_ = false;  // until the text changes
    bool stays_closed_ = false;  // keep the list closed when the field gets the keyboard again
    FolderReader reader_;
    std::string asked_folder_;  // folder of the pending request
    std::shared_ptr<const FolderListing> listing_;
    std::vector<std::string> offers_;  // complete paths; folders end with a slash
    int chosen_ = -1;                  // index of the offer chosen with the keys; -1: none
    std::string offered_for_;
};

/// Makes a typed path absolute: "~" is the home folder, and relative paths start at `folder`.
std::filesystem::path typedPath(const std::string& text, const std::filesystem::path& folder);

std::filesystem::path homeFolder();

}  // namespace dollytrack::ui
