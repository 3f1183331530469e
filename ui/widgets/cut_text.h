#pragma once

#include <imgui.h>

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::ui {

/// The part of a text that is dropped if it is too wide: the end, or the middle (for paths and for
/// names that end in a number).
enum class Cut { End, Middle };

/// Shortens a text with "…" to at most `width` px in the current font. UTF-8 characters stay whole.
[[nodiscard]] std::string cutToWidth(std::string_view text, float width, Cut cut = Cut::End);

/// Shortens the texts of a list, each in the middle. Those that would look alike lose the words
/// that they have in common at their beginning and end instead: "…sofa…" and "…lamp…" for
/// "flat-COLLADA-sofa-mesh" and "flat-COLLADA-lamp-mesh".
[[nodiscard]] std::vector<std::string> cutApart(const std::vector<std::string>& texts, float width);

/// Draws one line of text, shortened to `width` px; 0: to the space left in the line or column. The
/// tooltip shows the full text if it was shortened, then `tip`.
void cutText(const std::string& text, const ImVec4& color, const std::string& tip = {},
             Cut cut = Cut::End, float width = 0.0F);

/// The tooltip of the previous item, which shows `text` within `width` px: the full text if it does
/// not fit, then `tip`.
void wholeText(const std::string& text, float width, const std::string& tip = {});

}  // namespace dollytrack::ui
