#include "app/editor/shell/settings.h"

#include "engine/core/log.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace dollytrack::editor {
namespace {

/// Names in the order of TimelineStrip.
constexpr std::array<std::string_view, ui::kTimelineStrips> kStripNames = {
    "clearance", "speed", "turn", "score", "in_view", "captured", "image_corners", "overlap"};

constexpr std::size_t kMostRecent = 10;
constexpr std::size_t kMostSeen = 200;

std::filesystem::path userFolder(const char* variable, const char* fallback) {
    const char* value = std::getenv(variable);
    if (value != nullptr && value[0] == '/') return std::filesystem::path(value) / "dollytrack";
    const char* home = std::getenv("HOME");
    const std::filesystem::path root = home != nullptr && home[0] != '\0' ? home : "/tmp";
    return root / fallback / "dollytrack";
}

std::filesystem::path settingsFile() {
    return configFolder() / "editor.json";
}

void readPanels(const nlohmann::json& from, Layout& layout) {
    const nlohmann::json panels = from.value("panels", nlohmann::json::object());
    PanelPlaces places;
    for (const DockSide side : kDockSides) {
        const auto i = static_cast<std::size_t>(side);
        const std::string name(sideName(side));
        places.tabs[i] = panels.value(name, std::vector<std::string>());
        places.side_on[i] = from.value("show_" + name, true);
        layout.open_tabs[i] = from.value(name + "_tab", "");
    }
    places.hidden = panels.value("hidden", std::vector<std::string>());
    layout.panels = completePlaces(places);
}

void writePanels(const Layout& layout, nlohmann::json& to) {
    for (const DockSide side : kDockSides) {
        const auto i = static_cast<std::size_t>(side);
        const std::string name(sideName(side));
        to["panels"][name] = layout.panels.tabs[i];
        to["show_" + name] = layout.panels.side_on[i];
        to[name + "_tab"] = layout.open_tabs[i];
    }
    to["panels"]["hidden"] = layout.panels.hidden;
}

}  // namespace

std::filesystem::path configFolder() {
    return userFolder("XDG_CONFIG_HOME", ".config");
}

std::filesystem::path stateFolder() {
    return userFolder("XDG_STATE_HOME", ".local/state");
}

void EditorSettings::addRecent(const std::filesystem::path& path) {
    std::erase(recent, path.string());
    recent.insert(recent.begin(), path.string());
    if (recent.size() > kMostRecent) recent.resize(kMostRecent);
    last_folder = path.parent_path().string();
}

bool EditorSettings::hasSeen(const std::string& note) const {
    return std::ranges::find(seen, note) != seen.end();
}

void EditorSettings::addSeen(const std::string& note) {
    if (hasSeen(note)) return;
    seen.push_back(note);
    if (seen.size() > kMostSeen) seen.erase(seen.begin());
}

EditorSettings loadSettings() {
    EditorSettings settings;
    std::error_code error;
    if (!std::filesystem::exists(settingsFile(), error)) return settings;
    try {
        const nlohmann::json json = readBoundedJson(settingsFile()).value_or(nlohmann::json());
        const nlohmann::json window = json.value("window", nlohmann::json::object());
        settings.window.width = std::clamp(window.value("width", 1440), 800, 16384);
        settings.window.height = std::clamp(window.value("height", 900), 500, 16384);
        settings.window.maximized = window.value("maximized", false);
        const nlohmann::json layout = json.value("layout", nlohmann::json::object());
        settings.layout.left = layout.value("left", settings.layout.left);
        settings.layout.right = layout.value("right", settings.layout.right);
        settings.layout.bottom = layout.value("bottom", settings.layout.bottom);
        settings.layout.bottom_export =
            layout.value("bottom_export", settings.layout.bottom_export);
        settings.layout.show_preview = layout.value("show_preview", true);
        settings.layout.dock_preview = layout.value("dock_preview", true);
        readPanels(layout, settings.layout);
        const nlohmann::json layers = layout.value("layers", nlohmann::json::object());
        visitLayerSwitches(settings.layout.layers,
                           [&](const char* name, bool& on) { on = layers.value(name, on); });
        if (layout.contains("strips")) {
            const auto shown = layout["strips"].get<std::vector<std::string>>();
            for (std::size_t i = 0; i < ui::kTimelineStrips; ++i) {
                settings.layout.strips[i] = std::ranges::count(shown, kStripNames[i]) > 0;
            }
        }
        if (layout.contains("show_legend")) {
            settings.layout.show_legend = layout["show_legend"].get<bool>();
        }
        settings.theme =
            json.value("theme", "dark") == "light" ? ui::ThemeKind::Light : ui::ThemeKind::Dark;
        settings.zoom = std::clamp(json.value("zoom", 1.0), 0.5, 3.0);
        settings.recent = json.value("recent", std::vector<std::string>());
        if (settings.recent.size() > kMostRecent) settings.recent.resize(kMostRecent);
        settings.last_folder = json.value("last_folder", "");
        settings.seen = json.value("seen", std::vector<std::string>());
    } catch (const nlohmann::json::exception&) {
        log::warn("editor", settingsFile().string() + " cannot be read; using defaults");
        return {};
    }
    return settings;
}

Status saveSettings(const EditorSettings& settings) {
    nlohmann::json json = {{"window",
                            {{"width", settings.window.width},
                             {"height", settings.window.height},
                             {"maximized", settings.window.maximized}}},
                           {"layout",
                            {{"left", settings.layout.left},
                             {"right", settings.layout.right},
                             {"bottom", settings.layout.bottom},
                             {"bottom_export", settings.layout.bottom_export},
                             {"show_preview", settings.layout.show_preview},
                             {"dock_preview", settings.layout.dock_preview}}},
                           {"theme", settings.theme == ui::ThemeKind::Light ? "light" : "dark"},
                           {"zoom", settings.zoom},
                           {"recent", settings.recent},
                           {"last_folder", settings.last_folder},
                           {"seen", settings.seen}};
    writePanels(settings.layout, json["layout"]);
    nlohmann::json& layers = json["layout"]["layers"] = nlohmann::json::object();
    visitLayerSwitches(settings.layout.layers,
                       [&](const char* name, bool on) { layers[name] = on; });
    nlohmann::json& strips = json["layout"]["strips"] = nlohmann::json::array();
    for (std::size_t i = 0; i < ui::kTimelineStrips; ++i) {
        if (settings.layout.strips[i]) strips.push_back(kStripNames[i]);
    }
    if (settings.layout.show_legend) json["layout"]["show_legend"] = *settings.layout.show_legend;
    std::error_code error;
    std::filesystem::create_directories(configFolder(), error);
    return writeWhole(settingsFile(),
                      json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace dollytrack::editor
