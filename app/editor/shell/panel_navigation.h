#pragma once

namespace dollytrack::editor {

/// Decides in which window frames Dear ImGui moves a keyboard focus between widgets and presses the
/// focused one with Space or Enter: from Tab or Ctrl+Tab on, until a mouse button is pressed, the
/// mouse moves over the viewport, or Escape; and always in menus, lists and dialogs. At all other
/// times these keys are shortcuts only, so that Home and Space over the viewport never press the
/// button that was used last.
class PanelNavigation {
  public:
    /// To be called before ImGui's new frame, when its key states are up to date.
    void beginFrame();
    /// To be called after the widgets of a frame were drawn.
    void endFrame(bool mouse_over_viewport, bool dialog_open);

  private:
    bool by_keys_ = false;      // the user moves between widgets with the keyboard
    bool dialog_open_ = false;  // in the previous frame
};

}  // namespace dollytrack::editor
