#pragma once

#include <string>
#include <vector>

namespace dollytrack::ui {

/// A message over the window that waits for an answer.
struct MessageBox {
    bool is_error = false;
    std::string title;
    std::string text;                           // may have several lines
    std::vector<std::string> buttons = {"OK"};  // the first is what Enter presses
    int escape = -1;                            // button that Escape presses; -1: the last
};

/// Draws it in the middle of the window while it is given. Returns the button that was pressed, or
/// -1: then it must be drawn again in the next frame.
int drawMessageBox(const MessageBox& box);

enum class UnsavedAnswer { None, Save, Discard, Cancel };

/// Asks what shall become of unsaved changes before `what_next` ("before it is closed").
UnsavedAnswer askUnsaved(const std::string& project, const std::string& what_next);

}  // namespace dollytrack::ui
