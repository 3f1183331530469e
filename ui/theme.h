#pragma once

#include <imgui.h>

#include <string>

namespace dollytrack::ui {

enum class ThemeKind { Dark, Light };

/// Colours with a meaning, common to all panels.
struct Palette {
    ImVec4 text_dim, good, warning, bad, accent, panel_line;
};

struct Fonts {
    ImFont* text = nullptr;
    ImFont* bold = nullptr;
    ImFont* mono = nullptr;
};

/// Loads the fonts at `scale` (1: 96 dots per inch) into the atlas of the current ImGui context.
/// Falls back to ImGui's built-in font, with a logged warning, if the font packages are missing.
void loadFonts(double scale);
[[nodiscard]] const Fonts& fonts();

void applyTheme(ThemeKind kind, double scale);
[[nodiscard]] const Palette& palette();
/// Converts a length at 96 dots per inch to pixels of the screen.
[[nodiscard]] float scaled(float length);

}  // namespace dollytrack::ui
