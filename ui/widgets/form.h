#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

namespace dollytrack::ui {

/// Begins a two-column table of "name: value" rows; until endForm() only rows may follow. `names`
/// is the width of the left column as a fraction. If it returns false, nothing must be drawn.
bool beginForm(const char* id, float names = 0.36F);
void endForm();

/// Begins a row with a label; the cursor is then in the right column, at its full width.
void formLabel(const char* label, const std::string& tip = {});
/// Like formLabel(), for a lower row of text and links.
void formLine(const char* label, const std::string& tip = {});
/// A row of text; `tip` is the tooltip of both columns.
void formText(const char* label, const std::string& value, const std::string& tip = {});

/// A bold heading above a group of rows.
void heading(const char* text);
/// Wrapped text in a colour.
void paragraph(const std::string& text, const ImVec4& color);
void paragraph(const std::string& text);

/// The tooltip of the previous item, also if it is disabled. In the lower part of the window it is
/// drawn above the item, to keep the widgets below visible.
void tooltip(const std::string& text);

/// A tooltip beside the current window or list, which keeps the items below visible and clickable.
void tooltipBeside(const std::string& text);

/// Appearance and state of a button.
struct ButtonOptions {
    std::string why_not = {};  // not empty: the button is disabled, and its tooltip says why
    std::string tip = {};
    float width = 0.0F;    // px; 0: as wide as its text; negative: distance from the right edge
    bool small = false;    // as high as a line of text
    bool primary = false;  // highlighted: the button that Enter presses
};
/// A button called `name` in the item map; returns whether it was pressed.
bool button(const char* label, std::string_view name, const ButtonOptions& options = {});
/// Draws "reading NAME …" and a Cancel button called `name` in the item map; returns whether it was
/// pressed.
bool drawReading(const std::string& file, std::string_view name);
/// Draws a clickable text, such as "go to frame 12"; returns whether it was clicked.
bool link(const std::string& text, std::string_view name, const std::string& tip = {});

/// Style of dialog windows. Push before Begin...(), pop after it.
void pushDialogStyle();
void popDialogStyle();

/// Continues the current line if a button of this text fits into it. Not for the first button of a
/// row.
void flowTo(const char* next_label);

}  // namespace dollytrack::ui
