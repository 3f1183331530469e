#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

namespace dollytrack::ui {

/// Rows of "name: value" in two columns that line up; between the calls, rows only.
/// `names` is the share of the width that the left column takes.
bool beginForm(const char* id, float names = 0.36F);
void endForm();

/// Begins a row and leaves the cursor where its widget goes, with the column's full width.
void formLabel(const char* label, const std::string& tip = {});
/// The same for a row of text and links, which is less high than one of widgets.
void formLine(const char* label, const std::string& tip = {});
/// A row of text; `tip` appears over both columns.
void formText(const char* label, const std::string& value, const std::string& tip = {});

/// A bold line above a group of rows.
void heading(const char* text);
/// Text of several lines, in a colour; as wide as there is room.
void paragraph(const std::string& text, const ImVec4& color);
void paragraph(const std::string& text);

/// The tooltip of the item drawn last, also where that item is disabled. Low in the window it is
/// above the item: below it are the slider and the line that the item changes.
void tooltip(const std::string& text);

/// The same beside the window or list at hand: what is below the item can still be read and
/// clicked.
void tooltipBeside(const std::string& text);

/// How a button is drawn, and why it cannot be pressed.
struct ButtonOptions {
    std::string why_not = {};  // not empty: disabled, and this says why
    std::string tip = {};
    float width = 0.0F;    // 0: as wide as its text; negative: up to that far from the right
    bool small = false;    // as high as a line of text
    bool primary = false;  // what Enter would do
};
/// A button with its name for the item map.
bool button(const char* label, std::string_view name, const ButtonOptions& options = {});
/// The same as a word in running text: for "go to frame 12".
bool link(const std::string& text, std::string_view name, const std::string& tip = {});

/// What windows over the window look like. Between the two: Begin...().
void pushDialogStyle();
void popDialogStyle();

/// Whether a button of this text still fits on the line at hand; if so, goes on in that line.
/// Begin a row of buttons without it.
void flowTo(const char* next_label);

}  // namespace dollytrack::ui
