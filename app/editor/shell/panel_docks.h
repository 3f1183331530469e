#pragma once

#include "app/editor/shell/panel_places.h"
#include "app/editor/shell/tab_row.h"

#include <imgui.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::editor {

/// The rows of tabs on the sides of the window. A panel moves to another place when its tab is
/// dragged there, or by the tab's context menu.
class PanelDocks {
  public:
    /// The names of the selected tabs, by DockSide; empty: the first.
    using OpenTabs = std::array<std::string, kDockSides.size()>;

    void restore(const PanelPlaces& places, const OpenTabs& open);
    [[nodiscard]] const PanelPlaces& places() const { return places_; }
    [[nodiscard]] OpenTabs openTabs() const;
    /// Whether the panel's tab is the selected one of a visible side.
    [[nodiscard]] bool isOpen(std::string_view panel) const;

    void toggleSide(DockSide side);
    /// Selects the panel's tab, if it is docked.
    void select(const std::string& panel);
    /// The same; docks a hidden panel, and turns its side on.
    void open(const std::string& panel);
    void dock(const std::string& panel, DockSide side, std::string_view before = {});
    void hide(const std::string& panel);
    void reset();

    /// A number shown on a panel's tab, in the colour of warnings; 0: none.
    void setBadge(const std::string& panel, unsigned number) { badges_[panel] = number; }
    /// Draws the tabs of a side into the current window, and the selected panel by
    /// `draw_panel(name)`.
    void draw(DockSide side, const std::function<void(const std::string&)>& draw_panel);
    /// Draws and ends the drag of a tab; to be called after all sides are drawn. `low` and `high`
    /// bound the sides and the viewport, px. A tab that is dropped near the border of an empty side
    /// is docked there.
    void followDrag(ImVec2 low, ImVec2 high);
    /// A submenu for each panel, with its places.
    void drawMenu();

  private:
    struct Rectangle {
        ImVec2 low, high;  // px
        [[nodiscard]] bool contains(ImVec2 at) const;
    };
    struct Tab {
        std::string panel;
        DockSide side;
        Rectangle area;
    };
    struct Target {
        DockSide side;
        std::string before;  // the tab to insert before; empty: the last place
        Rectangle area;      // highlighted while dragging
    };

    void change(PanelPlaces places);
    void drawPlaces(const std::string& panel);
    [[nodiscard]] std::optional<Target> targetAt(ImVec2 mouse, const Rectangle& all) const;
    [[nodiscard]] Target targetInRow(DockSide side, ImVec2 mouse) const;

    PanelPlaces places_ = standardPlaces();
    std::array<TabRow, kDockSides.size()> rows_;
    // ImGui keeps the order of a row's tabs by the row's id; a new order needs a new id.
    std::array<int, kDockSides.size()> row_ids_{};
    std::map<std::string, unsigned> badges_;
    std::string dragged_;  // the panel whose tab is dragged, or empty
    std::string menu_of_;  // the panel whose context menu was opened last
    // Of this window frame:
    std::vector<Tab> tabs_;
    std::array<std::optional<Rectangle>, kDockSides.size()> sides_;  // set: drawn
    std::optional<PanelPlaces> wanted_places_;  // asked for by a tab's context menu
};

}  // namespace dollytrack::editor
