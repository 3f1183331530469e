#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::editor {

/// The sides of the window where panels are docked.
enum class DockSide { Left, Right, Bottom };
inline constexpr std::array<DockSide, 3> kDockSides = {DockSide::Left, DockSide::Right,
                                                       DockSide::Bottom};
/// As settings files and messages name them: "left", "right", "bottom".
[[nodiscard]] std::string_view sideName(DockSide side);

enum class Panel {
    Objects,
    Layers,
    ByHand,
    History,
    Parameters,
    Selection,
    Metrics,
    Timeline,
    Algorithm,
    Export,
    Log
};
/// The title of the panel's tab, and its name in settings files: "By hand".
[[nodiscard]] const std::string& panelName(Panel panel);
/// The panel with this name, which must be one of panelName().
[[nodiscard]] Panel panelNamed(std::string_view name);

/// On which side each panel is docked, by the panels' names. The panels of a side are tabs, in this
/// order.
struct PanelPlaces {
    std::array<std::vector<std::string>, kDockSides.size()> tabs;      // by DockSide
    std::array<bool, kDockSides.size()> side_on = {true, true, true};  // false: the user closed it
    std::vector<std::string> hidden;

    [[nodiscard]] const std::vector<std::string>& at(DockSide side) const;
    /// Whether the side is on, and has panels.
    [[nodiscard]] bool isVisible(DockSide side) const;
    /// The side of a panel; unset if it is hidden.
    [[nodiscard]] std::optional<DockSide> sideOf(std::string_view panel) const;

    /// Docks the panel on a side, before the tab `before`, or as the last tab if that is not there.
    /// Turns the side on.
    void dock(const std::string& panel, DockSide side, std::string_view before = {});
    void hide(const std::string& panel);
    /// Turns the panel's side on; docks a hidden panel on its standard side.
    void reveal(const std::string& panel);

    bool operator==(const PanelPlaces&) const = default;

  private:
    void take(std::string_view panel);
};

/// Every panel, where it is docked in a new installation.
[[nodiscard]] const PanelPlaces& standardPlaces();

/// The places with every panel exactly once: names that no panel has are left out, and missing
/// panels are added where standardPlaces() has them. For places read from a file.
[[nodiscard]] PanelPlaces completePlaces(const PanelPlaces& places);

}  // namespace dollytrack::editor
