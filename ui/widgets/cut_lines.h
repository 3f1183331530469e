#pragma once

#include <imgui.h>

#include <string>
#include <vector>

namespace dollytrack::ui {

/// A drawn line of text that is not shown in full.
struct CutLine {
    std::string text;  // the letters that are drawn, in whole or in part
    float left = 0, top = 0, right = 0, bottom = 0;  // window pixels
};

/// The lines of text of a rendered frame of which an edge on the left or right cuts a letter, and
/// those that were shortened with "…" directly after a letter. A cut between two letters is not
/// found, because ImGui does not draw the letters outside. Text hidden above or below an edge does
/// not count.
std::vector<CutLine> findCutLines(const ImDrawData& drawn);

/// Requests cutLines() of the next frame. Like the item map, it works on the current context.
void requestCutLines();
/// Finds them, if they are requested; to be called after ImGui::Render().
void noteCutLines();
/// Of the last frame for which they were requested.
const std::vector<CutLine>& cutLines();

}  // namespace dollytrack::ui
