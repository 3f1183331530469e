#pragma once

#include <functional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// A modal message that waits for an answer.
struct MessageBox {
    bool is_error = false;
    std::string title;
    std::string text;                           // may have several lines
    std::vector<std::string> buttons = {"OK"};  // the first is pressed by Enter
    int escape = -1;                            // button that Escape presses; -1: the last
    // Draws a field above the buttons, and returns whether the first button can be pressed.
    std::function<bool()> field = {};
};

/// Draws the message in the middle of the window; to be called every frame until it is answered.
/// Returns the index of the pressed button, or -1.
int drawMessageBox(const MessageBox& box);

enum class UnsavedAnswer { None, Save, Discard, Cancel };

/// Asks whether to save unsaved changes. `question` says what would be saved; `what_next` completes
/// "Your changes are lost if you do not save them ...", such as "before it is closed".
UnsavedAnswer askUnsaved(const std::string& question, const std::string& what_next);

}  // namespace dollytrack::ui
