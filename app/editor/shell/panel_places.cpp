#include "app/editor/shell/panel_places.h"

#include <algorithm>
#include <cstddef>

namespace dollytrack::editor {
namespace {

struct StandardPlace {
    Panel panel;
    std::string name;
    DockSide side;
};

/// All panels, in the order of Panel, which is that of their tabs.
const std::vector<StandardPlace>& panels() {
    static const std::vector<StandardPlace> kPanels = {
        {Panel::Objects, "Objects", DockSide::Left},
        {Panel::Layers, "Layers", DockSide::Left},
        {Panel::ByHand, "By hand", DockSide::Left},
        {Panel::History, "History", DockSide::Left},
        {Panel::Parameters, "Parameters", DockSide::Right},
        {Panel::Selection, "Selection", DockSide::Right},
        {Panel::Metrics, "Metrics", DockSide::Right},
        {Panel::Timeline, "Timeline", DockSide::Bottom},
        {Panel::Algorithm, "Algorithm", DockSide::Bottom},
        {Panel::Export, "Export", DockSide::Bottom},
        {Panel::Log, "Log", DockSide::Bottom}};
    return kPanels;
}

}  // namespace

const std::string& panelName(Panel panel) {
    return panels().at(static_cast<std::size_t>(panel)).name;
}

Panel panelNamed(std::string_view name) {
    return std::ranges::find(panels(), name, &StandardPlace::name)->panel;
}

std::string_view sideName(DockSide side) {
    constexpr std::array<std::string_view, kDockSides.size()> kNames = {"left", "right", "bottom"};
    return kNames[static_cast<std::size_t>(side)];
}

const std::vector<std::string>& PanelPlaces::at(DockSide side) const {
    return tabs[static_cast<std::size_t>(side)];
}

bool PanelPlaces::isVisible(DockSide side) const {
    return side_on[static_cast<std::size_t>(side)] && !at(side).empty();
}

std::optional<DockSide> PanelPlaces::sideOf(std::string_view panel) const {
    for (const DockSide side : kDockSides) {
        if (std::ranges::count(at(side), panel) > 0) return side;
    }
    return std::nullopt;
}

void PanelPlaces::take(std::string_view panel) {
    for (std::vector<std::string>& row : tabs) std::erase(row, panel);
    std::erase(hidden, panel);
}

void PanelPlaces::dock(const std::string& panel, DockSide side, std::string_view before) {
    if (panel == before) return;
    take(panel);
    std::vector<std::string>& row = tabs[static_cast<std::size_t>(side)];
    row.insert(std::ranges::find(row, before), panel);
    side_on[static_cast<std::size_t>(side)] = true;
}

void PanelPlaces::hide(const std::string& panel) {
    take(panel);
    hidden.push_back(panel);
}

void PanelPlaces::reveal(const std::string& panel) {
    if (const std::optional<DockSide> side = sideOf(panel)) {
        side_on[static_cast<std::size_t>(*side)] = true;
    } else if (const std::optional<DockSide> standard = standardPlaces().sideOf(panel)) {
        dock(panel, *standard);
    }
}

const PanelPlaces& standardPlaces() {
    static const PanelPlaces kPlaces = [] {
        PanelPlaces places;
        for (const StandardPlace& place : panels()) places.dock(place.name, place.side);
        return places;
    }();
    return kPlaces;
}

PanelPlaces completePlaces(const PanelPlaces& places) {
    PanelPlaces complete;
    const auto isNew = [&](const std::string& panel) {
        return standardPlaces().sideOf(panel) && !complete.sideOf(panel) &&
               std::ranges::count(complete.hidden, panel) == 0;
    };
    for (const DockSide side : kDockSides) {
        for (const std::string& panel : places.at(side)) {
            if (isNew(panel)) complete.dock(panel, side);
        }
    }
    for (const std::string& panel : places.hidden) {
        if (isNew(panel)) complete.hide(panel);
    }
    for (const DockSide side : kDockSides) {
        for (const std::string& panel : standardPlaces().at(side)) {
            if (isNew(panel)) complete.dock(panel, side);
        }
    }
    complete.side_on = places.side_on;
    return complete;
}

}  // namespace dollytrack::editor
