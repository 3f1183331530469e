#include "ui/viewport/legend_view.h"

#include "ui/overlays/palette.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

ImU32 toColor(const Eigen::Vector4f& rgba) {
    // Opaque enough to be recognizable on the panel.
    return ImGui::GetColorU32(ImVec4(rgba.x(), rgba.y(), rgba.z(), std::max(rgba.w(), 0.7F)));
}

float brightness(const Eigen::Vector4f& rgba) {
    return 0.3F * rgba.x() + 0.6F * rgba.y() + 0.1F * rgba.z();
}

/// Symbols are coloured for the scene; on a panel of similar brightness they get a background.
void drawBacking(const LegendEntry& entry, ImVec2 low, ImVec2 high) {
    const ImVec4 panel = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    const float behind = brightness({panel.x, panel.y, panel.z, 1.0F});
    if (std::abs(brightness(entry.rgba) - behind) > 0.15F) return;
    const float gray = behind > 0.5F ? 0.35F : 0.65F;
    ImGui::GetWindowDrawList()->AddRectFilled(
        low, high, ImGui::GetColorU32(ImVec4(gray, gray, gray, 1.0F)), scaled(3));
}

/// Draws the symbol as in the scene, in a box one text line high.
void drawSign(const LegendEntry& entry) {
    using Shape = LegendEntry::Shape;
    const float height = ImGui::GetTextLineHeight();
    const float width = 1.6F * height;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 c(low.x + width / 2, low.y + height / 2);
    const float r = height * 0.3F;
    const float stroke = scaled(2);
    const ImU32 color = toColor(entry.rgba);
    drawBacking(entry, low, {low.x + width, low.y + height});
    ImDrawList* list = ImGui::GetWindowDrawList();
    switch (entry.shape) {
        case Shape::Dot:
            list->AddCircleFilled(c, r, color);
            break;
        case Shape::SmallDot:
            list->AddCircleFilled(c, r * 0.6F, color);
            break;
        case Shape::Cross:
            list->AddLine({c.x - r, c.y - r}, {c.x + r, c.y + r}, color, stroke);
            list->AddLine({c.x - r, c.y + r}, {c.x + r, c.y - r}, color, stroke);
            break;
        case Shape::Ring:
            list->AddCircle(c, r, color, 0, stroke);
            break;
        case Shape::Arrow:
            list->AddLine({c.x - 1.5F * r, c.y}, {c.x + r, c.y}, color, stroke);
            list->AddTriangleFilled({c.x + 0.3F * r, c.y - 0.8F * r}, {c.x + 1.6F * r, c.y},
                                    {c.x + 0.3F * r, c.y + 0.8F * r}, color);
            break;
        case Shape::Line:
            list->AddLine({low.x + scaled(2), c.y}, {low.x + width - scaled(2), c.y}, color,
                          stroke);
            break;
        case Shape::DashedLine:
            for (const float at : {0.08F, 0.41F, 0.74F}) {
                const float x = low.x + at * width;
                list->AddLine({x, c.y}, {x + 0.2F * width, c.y}, color, stroke);
            }
            break;
        case Shape::Block:
            list->AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, color);
            break;
    }
    ImGui::Dummy({width, height});
}

void drawScale(const LegendScale& scale) {
    constexpr int kPieces = 24;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const std::string begin = fmt::format("{:.3g}", scale.min);
    const std::string end = fmt::format("{:.3g} {}", scale.max, scale.unit);
    const float end_width = ImGui::CalcTextSize(end.c_str()).x;
    const float labels = ImGui::CalcTextSize(begin.c_str()).x + end_width + scaled(16);
    const float width = std::max(std::min(ImGui::GetContentRegionAvail().x, scaled(240)), labels);
    const float height = scaled(10);
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (int i = 0; i < kPieces; ++i) {
        const auto at = [&](int piece) {
            return low.x + width * static_cast<float>(piece) / kPieces;
        };
        const ImU32 left = toColor(scaleColor(double(i) / kPieces));
        const ImU32 right = toColor(scaleColor(double(i + 1) / kPieces));
        list->AddRectFilledMultiColor({at(i), low.y}, {at(i + 1), low.y + height}, left, right,
                                      right, left);
    }
    ImGui::Dummy({width, height});
    ImGui::TextColored(palette().text_dim, "%s", begin.c_str());
    ImGui::SameLine();
    ImGui::SetCursorScreenPos({low.x + width - end_width, ImGui::GetCursorScreenPos().y});
    ImGui::TextColored(palette().text_dim, "%s", end.c_str());
}

/// Draws a legend without its title. `room`: width that names are cut to, px; 0: not cut.
void drawLegend(const Legend& legend, float room) {
    for (const LegendEntry& entry : legend.entries) {
        const std::string count = std::to_string(entry.count);
        drawSign(entry);
        ImGui::SameLine();
        const float left = room - 1.6F * ImGui::GetTextLineHeight() -
                           2 * ImGui::GetStyle().ItemSpacing.x -
                           ImGui::CalcTextSize(count.c_str()).x;
        if (room > 0.0F) {
            cutText(entry.name, ImGui::GetStyleColorVec4(ImGuiCol_Text), {}, Cut::End,
                    std::max(left, scaled(40)));
        } else {
            ImGui::TextUnformatted(entry.name.c_str());
        }
        ImGui::SameLine();
        ImGui::TextColored(palette().text_dim, "%s", count.c_str());
    }
    if (!legend.scale) return;
    if (!legend.scale->name.empty() && legend.scale->name != legend.title) {
        ImGui::TextUnformatted(legend.scale->name.c_str());
    }
    drawScale(*legend.scale);
}

bool isEmpty(const Legend& legend) {
    return legend.entries.empty() && !legend.scale;
}

}  // namespace

void drawLegends(const std::vector<Legend>& legends) {
    for (const Legend& legend : legends) {
        if (isEmpty(legend)) continue;
        heading(legend.title.c_str());
        drawLegend(legend, ImGui::GetContentRegionAvail().x);
    }
}

void drawLegendBox(const std::vector<Legend>& legends, ImVec2 low, ImVec2 room,
                   LegendBoxState& state) {
    const ImVec2 size(std::min(state.size.x, room.x), std::min(state.size.y, room.y));
    ImVec4 back = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    back.w = 0.97F;
    ImGui::SetCursorScreenPos(low);
    ImGui::PushStyleColor(ImGuiCol_ChildBg, back);
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, scaled(5));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(8), scaled(5)});
    // A child window, since a separate window would lie above the dimming behind dialogs.
    ImGui::BeginChild(
        "legend", {std::max(size.x, 1.0F), std::max(size.y, 1.0F)}, true,
        // Home and the arrow keys belong to the viewport.
        ImGuiWindowFlags_NoNav | (size.y < state.size.y ? 0 : ImGuiWindowFlags_NoScrollbar));
    nameArea("legend", low.x, low.y, low.x + size.x, low.y + size.y);
    state.hovered = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    ImGui::BeginGroup();
    if (button(state.open ? "\u25be Legend" : "\u25b8 Legend", "legend.title",
               {.tip = state.open ? "Collapse the legend" : "Meaning of the symbols and colours",
                .small = true})) {
        state.open = !state.open;
    }
    for (const Legend& legend : legends) {
        if (!state.open || isEmpty(legend)) continue;
        const auto folded = std::ranges::find(state.folded, legend.title);
        const bool shown = folded == state.folded.end();
        const std::string title = (shown ? "\u25be " : "\u25b8 ") + legend.title;
        if (button(title.c_str(), "legend." + legend.title, {.small = true})) {
            shown ? state.folded.push_back(legend.title) : void(state.folded.erase(folded));
        }
        if (shown) drawLegend(legend, 0.0F);
    }
    ImGui::EndGroup();
    const bool scrolls = size.y < state.size.y;
    state.size = {ImGui::GetItemRectSize().x + 2 * scaled(8) +
                      (scrolls ? ImGui::GetStyle().ScrollbarSize : 0.0F),
                  ImGui::GetItemRectSize().y + 2 * scaled(5)};
    ImGui::EndChild();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

}  // namespace dollytrack::ui
