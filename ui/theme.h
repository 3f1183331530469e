#pragma once

#include <imgui.h>

#include <string>

namespace dollytrack::ui {

enum class ThemeKind { Dark, Light };

/// Colours with a meaning, the same in every panel.
struct Palette {
    ImVec4 text_dim, good, warning, bad, accent, panel_line;
};

struct Fonts {
    ImFont* text = nullptr;
    ImFont* bold = nullptr;
    ImFont* mono = nullptr;
};

/// Loads the fonts at `scale` (1: 96 dots per inch) into the atlas of the current context. Falls
/// back to ImGui's own font, with a warning in the log, where the packages are missing.
void loadFonts(double scale);
[[nodiscard]] const Fonts& fonts();

void applyTheme(ThemeKind kind, double scale);
[[nodiscard]] const Palette& palette();
/// Lengths in the code are for 96 dots per inch; this makes them right for the screen.
[[nodiscard]] float scaled(float length);

}  // namespace dollytrack::ui
