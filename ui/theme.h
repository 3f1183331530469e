#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

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

/// Registers the letters of `text` (UTF-8) that loadFonts() does not always load, for example
/// Chinese or Russian ones. Returns whether any of them is new; then the fonts must be loaded
/// again.
bool addLetters(std::string_view text);
/// Loads the fonts at `scale` (1: 96 dots per inch) into the atlas of the current ImGui context.
/// Falls back to ImGui's built-in font, with a logged warning, if the font packages are missing.
void loadFonts(double scale);
[[nodiscard]] const Fonts& fonts();

void applyTheme(ThemeKind kind, double scale);
[[nodiscard]] const Palette& palette();
/// Converts a length at 96 dots per inch to pixels of the screen.
[[nodiscard]] float scaled(float length);

}  // namespace dollytrack::ui
