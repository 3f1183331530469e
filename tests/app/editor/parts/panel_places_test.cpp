#include "app/editor/shell/panel_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace dollytrack::editor {
namespace {

using Names = std::vector<std::string>;

Names sorted(const PanelPlaces& places) {
    Names all = places.hidden;
    for (const Names& row : places.tabs) all.insert(all.end(), row.begin(), row.end());
    std::ranges::sort(all);
    return all;
}

TEST(PanelPlaces, EveryPanelHasANameAndAStandardPlace) {
    std::size_t count = 0;
    for (const Names& row : standardPlaces().tabs) count += row.size();
    EXPECT_EQ(count, static_cast<std::size_t>(Panel::Log) + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const auto panel = static_cast<Panel>(i);
        EXPECT_EQ(panelNamed(panelName(panel)), panel) << panelName(panel);
        EXPECT_TRUE(standardPlaces().sideOf(panelName(panel))) << panelName(panel);
    }
    EXPECT_EQ(panelName(Panel::ByHand), "By hand");
}

TEST(PanelPlaces, APanelMovesBeforeAnotherOrToTheEnd) {
    PanelPlaces places = standardPlaces();
    places.dock("Log", DockSide::Left, "Layers");
    EXPECT_EQ(places.at(DockSide::Left), (Names{"Objects", "Log", "Layers", "By hand", "History"}));
    EXPECT_EQ(places.at(DockSide::Bottom), (Names{"Timeline", "Algorithm", "Export"}));
    places.dock("Objects", DockSide::Left);
    EXPECT_EQ(places.at(DockSide::Left), (Names{"Log", "Layers", "By hand", "History", "Objects"}));
    places.dock("Metrics", DockSide::Right, "Metrics");
    EXPECT_EQ(places.at(DockSide::Right), standardPlaces().at(DockSide::Right));
    EXPECT_EQ(sorted(places), sorted(standardPlaces()));
}

TEST(PanelPlaces, AHiddenPanelComesBackWhenItIsRevealed) {
    PanelPlaces places = standardPlaces();
    places.hide("Export");
    EXPECT_FALSE(places.sideOf("Export"));
    places.reveal("Export");
    EXPECT_EQ(places.sideOf("Export"), DockSide::Bottom);
    places.dock("Export", DockSide::Right);
    places.side_on = {false, false, false};
    places.reveal("Export");
    EXPECT_TRUE(places.isVisible(DockSide::Right));
    EXPECT_FALSE(places.isVisible(DockSide::Left));
}

TEST(PanelPlaces, ASideWithoutPanelsIsInvisible) {
    PanelPlaces places = standardPlaces();
    for (const std::string& panel : standardPlaces().at(DockSide::Right)) places.hide(panel);
    EXPECT_FALSE(places.isVisible(DockSide::Right));
    places.dock("Metrics", DockSide::Right);
    EXPECT_TRUE(places.isVisible(DockSide::Right));
}

TEST(PanelPlaces, PlacesFromAFileHaveEveryPanelOnce) {
    PanelPlaces file;
    file.tabs[0] = {"Log", "Log", "Nonsense", ""};
    file.tabs[1] = {"Log", "Timeline"};
    file.hidden = {"Timeline", "Metrics"};
    file.side_on[2] = false;
    const PanelPlaces places = completePlaces(file);
    EXPECT_EQ(sorted(places), sorted(standardPlaces()));
    EXPECT_EQ(places.at(DockSide::Left).front(), "Log");
    EXPECT_EQ(places.sideOf("Timeline"), DockSide::Right);
    EXPECT_EQ(places.hidden, Names{"Metrics"});
    EXPECT_FALSE(places.isVisible(DockSide::Bottom));
    EXPECT_EQ(completePlaces(PanelPlaces()), standardPlaces());
    EXPECT_EQ(completePlaces(places), places);
}

}  // namespace
}  // namespace dollytrack::editor
