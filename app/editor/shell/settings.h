#pragma once

#include "app/editor/shell/window.h"
#include "engine/core/result.h"
#include "ui/layers.h"
#include "ui/panels/timeline/timeline_panel.h"
#include "ui/theme.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// Which layers are drawn, by their names in the settings' file: what they show in detail belongs
/// to the scene.
template <class Layers, class Visitor>
void visitLayerSwitches(Layers& switches, Visitor&& visit) {
    visit("free_space", switches.free_space);
    visit("points", switches.points);
    visit("roadmap", switches.roadmap);
    visit("trajectory", switches.trajectory);
    visit("candidates", switches.candidates);
    visit("cone", switches.cone);
    visit("no_go_boxes", switches.no_go_boxes);
    visit("ceiling_cut", switches.ceiling_cut);
    visit("grid", switches.grid);
}

/// Sizes of the window's parts, px at 96 dots per inch.
struct Layout {
    float left = 280;
    float right = 330;
    float bottom = 205;
    bool show_left = true;
    bool show_right = true;
    bool show_bottom = true;
    std::optional<bool> show_legend;  // none: where the viewport has room for it
    bool show_preview = true;         // else only its bar
    std::array<bool, ui::kTimelineStrips> strips = ui::TimelineState().strips;
    // The tabs in front, by their names; empty: the first.
    std::string left_tab;
    std::string right_tab;
    std::string bottom_tab;
    ui::LayerSettings layers;  // only its switches are kept
    bool operator==(const Layout&) const = default;
};

/// What the editor remembers from one start to the next: not about a project, about the person.
struct EditorSettings {
    WindowSettings window;
    Layout layout;
    ui::ThemeKind theme = ui::ThemeKind::Dark;
    double zoom = 1.0;                // of all widgets, on top of the screen's own scale
    std::vector<std::string> recent;  // newest first
    std::string last_folder;
    bool operator==(const EditorSettings&) const = default;

    void addRecent(const std::filesystem::path& path);
};

/// $XDG_CONFIG_HOME/dollytrack, $XDG_STATE_HOME/dollytrack, or their places under the home folder.
[[nodiscard]] std::filesystem::path configFolder();
[[nodiscard]] std::filesystem::path stateFolder();

/// Defaults where the file is missing or unreadable: settings never keep the editor from starting.
[[nodiscard]] EditorSettings loadSettings();
Status saveSettings(const EditorSettings& settings);

}  // namespace dollytrack::editor
