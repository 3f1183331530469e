#pragma once

#include <string>

namespace dollytrack::editor {

/// A row of tabs, and which of them is in front: also the one that was when the editor ended.
class TabRow {
  public:
    /// Opens this one when the row is drawn next; empty: the first.
    void restore(const std::string& tab) { open_ = wanted_ = tab; }
    /// After the last tab: one that is wanted and not among them is wanted no more.
    void end();
    /// The one in front, or that will be.
    [[nodiscard]] const std::string& open() const { return open_; }

    /// Within ImGui's tab bar. A tab comes to the front when `focus` names it, which is then
    /// cleared. Returns whether its content is to be drawn, before ImGui::EndTabItem().
    bool begin(const char* name, std::string& focus);

  private:
    std::string open_;
    std::string wanted_;
    bool met_wanted_ = false;  // in this row
};

}  // namespace dollytrack::editor
