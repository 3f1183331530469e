#include "app/editor/editor.h"

#include <GLFW/glfw3.h>

namespace dollytrack::editor {

void Editor::addCommands() {
    const auto needs_scene = [this] {
        return workspace_.isOpen() ? std::string() : std::string("No scene is open.");
    };
    commands_.add({"file.save",
                   "File",
                   "Save",
                   {GLFW_KEY_S, true},
                   [this] { workspace_.save(workspace_.path()); },
                   needs_scene});
    commands_.add({"file.quit", "File", "Quit", {GLFW_KEY_Q, true}, [this] { quitting_ = true; }});
    commands_.add(
        {"edit.undo",
         "Edit",
         "Undo",
         {GLFW_KEY_Z, true},
         [this] { workspace_.undo(); },
         [this] { return workspace_.history().canUndo() ? "" : "There is nothing to undo."; }});
    commands_.add(
        {"edit.redo",
         "Edit",
         "Redo",
         {GLFW_KEY_Z, true, true},
         [this] { workspace_.redo(); },
         [this] { return workspace_.history().canRedo() ? "" : "There is nothing to redo."; }});
}

}  // namespace dollytrack::editor
