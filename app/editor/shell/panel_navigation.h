#pragma once

namespace dollytrack::editor {

/// Decides in which window frames Dear ImGui moves a keyboard focus between widgets and presses the
/// focused one with Space or Enter. It does so after Tab or Ctrl+Tab, until a mouse button or
/// Escape is pressed or the mouse moves over the viewport, and always in menus, lists and dialogs.
/// At all other times these keys are shortcuts only, so that Home and Space over the viewport never
/// press the button that was used last.
class PanelNavigation {
  public:
    /// Must be called before ImGui::NewFrame(), when the key states are up to date.
    void beginFrame();
    /// Must be called after the widgets of a frame were drawn. With `keys_taken`, a move or
    /// rotation by keys uses the keys of the next frame, and Tab does not move the focus.
    void endFrame(bool mouse_over_viewport, bool dialog_open, bool keys_taken);

  private:
    bool by_keys_ = false;      // the user moves between widgets with the keyboard
    bool dialog_open_ = false;  // in the previous frame
    bool keys_taken_ = false;   // in the previous frame
};

}  // namespace dollytrack::editor
