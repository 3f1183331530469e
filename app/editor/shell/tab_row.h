#pragma once

#include <string>

namespace dollytrack::editor {

/// The selected tab of a tab bar.
class TabRow {
  public:
    /// Selects this tab at the next draw; empty: the first.
    void select(const std::string& tab) { open_ = wanted_ = tab; }
    /// To be called after the last tab: drops a wanted tab that does not exist.
    void end();
    /// The selected tab, or the one that will be.
    [[nodiscard]] const std::string& open() const { return open_; }

    /// Begins the row; if it returns true, ImGui::EndTabBar() follows the last tab.
    bool beginRow(const char* id);
    /// To be called within the row. A `badge` above 0 is shown after the name, in the colour of
    /// warnings. Returns whether the tab's content is to be drawn, followed by ImGui::EndTabItem().
    bool begin(const char* name, unsigned badge = 0);

  private:
    std::string open_;
    std::string wanted_;
    std::string wanted_before_;  // when the row began
    bool met_wanted_ = false;    // the wanted tab occurred in this row
};

}  // namespace dollytrack::editor
