#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

namespace dollytrack::ui {

/// What of a text goes when there is too little room: its end, or the middle, as with names that
/// differ in their number and with paths.
enum class Cut { End, Middle };

/// The text as it is, or cut so that with "…" it is no wider than `width` in the font at hand.
/// UTF-8 stays whole.
[[nodiscard]] std::string cutToWidth(std::string_view text, float width, Cut cut = Cut::End);

/// Text in one line no wider than `width`, 0: than what is left of the line or column. Where it is
/// cut the tooltip has the whole of it, above `tip`.
void cutText(const std::string& text, const ImVec4& color, const std::string& tip = {},
             Cut cut = Cut::End, float width = 0.0F);

/// The tooltip of the item drawn last, which shows `text` in `width`: the whole text where that is
/// too narrow, and `tip`.
void wholeText(const std::string& text, float width, const std::string& tip = {});

}  // namespace dollytrack::ui
