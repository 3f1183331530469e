#pragma once

#include "app/editor/shell/panel_docks.h"
#include "app/editor/shell/window.h"
#include "engine/core/result.h"
#include "ui/overlays/layers.h"
#include "ui/panels/timeline/timeline_panel.h"
#include "ui/theme.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// The layer switches, by their names in the settings file. Other layer options belong to the scene
/// and are not stored.
template <class Layers, class Visitor>
void visitLayerSwitches(Layers& switches, Visitor&& visit) {
    visit("free_space", switches.free_space);
    visit("points", switches.points);
    visit("roadmap", switches.roadmap);
    visit("trajectory", switches.trajectory);
    visit("candidates", switches.candidates);
    visit("cone", switches.cone);
    visit("surface", switches.surface);
    visit("quality", switches.quality);
    visit("kept_plan", switches.kept_plan);
    visit("no_go_boxes", switches.no_go_boxes);
    visit("ceiling_cut", switches.ceiling_cut);
    visit("grid", switches.grid);
}

/// Sizes of the panels, px at 96 dots per inch, and where each is.
struct Layout {
    float left = 280;
    float right = 330;
    float bottom = 205;
    float bottom_export = 310;        // instead of `bottom` while the export form is open
    std::optional<bool> show_legend;  // unset: shown if the viewport has room for it
    bool show_preview = true;         // false: only its title bar
    bool dock_preview = true;         // beside the timeline; false: over the viewport
    std::array<bool, ui::kTimelineStrips> strips = ui::TimelineState().strips;
    PanelPlaces panels = standardPlaces();
    PanelDocks::OpenTabs open_tabs;
    ui::LayerSettings layers;  // only the switches are stored
    bool operator==(const Layout&) const = default;
};

/// User settings that persist between sessions, independent of the project.
struct EditorSettings {
    WindowSettings window;
    Layout layout;
    ui::ThemeKind theme = ui::ThemeKind::Dark;
    double zoom = 1.0;                // scale of all widgets, multiplied by the screen's own scale
    std::vector<std::string> recent;  // newest first
    std::string last_folder;
    std::vector<std::string> seen;  // notes that must not be shown again for a file, oldest first
    bool operator==(const EditorSettings&) const = default;

    void addRecent(const std::filesystem::path& path);
    [[nodiscard]] bool hasSeen(const std::string& note) const;
    /// Remembers that a note was shown, and forgets the oldest of more than 200 notes.
    void addSeen(const std::string& note);
    void removeRecent(const std::string& path) { std::erase(recent, path); }
};

/// $XDG_CONFIG_HOME/dollytrack and $XDG_STATE_HOME/dollytrack, or their defaults below the home
/// folder.
[[nodiscard]] std::filesystem::path configFolder();
[[nodiscard]] std::filesystem::path stateFolder();

/// Loads the settings; defaults if the file is missing or unreadable, which must not keep the
/// editor from starting.
[[nodiscard]] EditorSettings loadSettings();
Status saveSettings(const EditorSettings& settings);

}  // namespace dollytrack::editor
