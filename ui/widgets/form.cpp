#include "ui/widgets/form.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/item_map.h"

#include <algorithm>
#include <utility>

namespace dollytrack::ui {
namespace {

/// Not during a drag, when a tooltip would cover what changes.
bool wantsTooltip() {
    return ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) &&
           !ImGui::IsMouseDragging(ImGuiMouseButton_Left);
}

void drawTooltip(const std::string& text) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(scaled(340));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// Breaks a text into lines of this width, px. ImGui's own breaks are also after the point of a
/// decimal number.
std::string brokenAtSpaces(const std::string& text, float width) {
    std::string broken;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && ImGui::CalcTextSize((line + word).c_str()).x > width) {
            line.back() = '\n';
            broken += line;
            line.clear();
        }
        line += word;
        if (end < text.size()) line += text[end];
        if (end < text.size() && text[end] == '\n') broken += std::exchange(line, {});
        at = end + 1;
    }
    return broken + line;
}

}  // namespace

bool beginForm(const char* id, float names) {
    if (!ImGui::BeginTable(id, 2)) return false;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, names);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1.0F - names);
    return true;
}

void endForm() {
    ImGui::EndTable();
}

void formLabel(const char* label, const std::string& tip) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(palette().text_dim, "%s", label);
    tooltip(tip);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
}

void formLine(const char* label, const std::string& tip) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(palette().text_dim, "%s", label);
    tooltip(tip);
    ImGui::TableNextColumn();
}

void formText(const char* label, const std::string& value, const std::string& tip) {
    formLine(label, tip);
    ImGui::TextWrapped("%s", value.c_str());
    tooltip(tip);
}

void heading(const char* text) {
    ImGui::Spacing();
    ImGui::PushFont(fonts().bold);
    ImGui::TextWrapped("%s", text);
    ImGui::PopFont();
}

void paragraph(const std::string& text, const ImVec4& color) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(0.0F);  // for words longer than a line
    ImGui::TextUnformatted(brokenAtSpaces(text, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void paragraph(const std::string& text) {
    paragraph(text, ImGui::GetStyleColorVec4(ImGuiCol_Text));
}

void tooltip(const std::string& text) {
    if (text.empty() || !wantsTooltip()) return;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float top = ImGui::GetItemRectMin().y;
    if (top > 0.6F * window.y) {
        const float x = ImGui::GetIO().MousePos.x;
        ImGui::SetNextWindowPos({x, top - scaled(4)}, ImGuiCond_Always,
                                {x < 0.5F * window.x ? 0.0F : 1.0F, 1.0F});
    }
    drawTooltip(text);
}

void tooltipBeside(const std::string& text) {
    if (text.empty() || !wantsTooltip()) return;
    const float left = ImGui::GetWindowPos().x;
    const float right = left + ImGui::GetWindowWidth();
    const bool has_room = right + scaled(200) < ImGui::GetIO().DisplaySize.x;
    ImGui::SetNextWindowPos(
        {has_room ? right + scaled(6) : left - scaled(6), ImGui::GetItemRectMin().y},
        ImGuiCond_Always, {has_room ? 0.0F : 1.0F, 0.0F});
    drawTooltip(text);
}

bool button(const char* label, std::string_view name, const ButtonOptions& options) {
    const bool enabled = options.why_not.empty();
    // The window's colour is readable on the accent colour in both themes.
    const bool stands_out = options.primary && enabled;
    if (stands_out) {
        ImVec4 hovered = palette().accent;
        hovered.w = 0.85F;
        ImGui::PushStyleColor(ImGuiCol_Button, palette().accent);
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, hovered);
        ImGui::PushStyleColor(ImGuiCol_ButtonActive, hovered);
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_WindowBg));
        ImGui::PushFont(fonts().bold);
    }
    ImGui::BeginDisabled(!enabled);
    const bool pressed =
        options.small ? ImGui::SmallButton(label) : ImGui::Button(label, {options.width, 0});
    ImGui::EndDisabled();
    if (stands_out) {
        ImGui::PopFont();
        ImGui::PopStyleColor(4);
    }
    nameItem(name, enabled);
    tooltip(enabled ? options.tip : options.why_not);
    return pressed;
}

bool drawReading(const std::string& file, std::string_view name) {
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize("Cancel").x -
                       2 * ImGui::GetStyle().FramePadding.x - ImGui::GetStyle().ItemSpacing.x;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled(
        "%s",
        cutToWidth("reading " + file + " \u2026", std::max(room, scaled(60)), Cut::Middle).c_str());
    ImGui::SameLine();
    return button("Cancel", name, {.tip = "Stop waiting for this file"});
}

bool link(const std::string& text, std::string_view name, const std::string& tip) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    ImGui::PushID(name.data(), name.data() + name.size());
    // A minimum width, in case the line is nearly full.
    const float room = std::max(ImGui::GetContentRegionAvail().x, scaled(60));
    const std::string shown = cutToWidth(text, room, Cut::Middle);
    const bool pressed =
        ImGui::Selectable(shown.c_str(), false, 0, ImGui::CalcTextSize(shown.c_str()));
    ImGui::PopID();
    ImGui::PopStyleColor();
    nameItem(name);
    if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    wholeText(text, room, tip);
    return pressed;
}

void pushDialogStyle() {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(18), scaled(14)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, scaled(6));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0F);
    // Input fields contrast with the window's colour, not with that of menus.
    ImGui::PushStyleColor(ImGuiCol_PopupBg, ImGui::GetStyleColorVec4(ImGuiCol_WindowBg));
}

void popDialogStyle() {
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
}

void flowTo(const char* next_label) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(next_label, nullptr, true).x + 2 * style.FramePadding.x;
    const float right_end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + style.ItemSpacing.x + width <= right_end) ImGui::SameLine();
}

}  // namespace dollytrack::ui
