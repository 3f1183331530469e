#include "ui/widgets/icon_button.h"

#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

/// Draws shapes in the square -1..1, y down.
class IconPen {
  public:
    IconPen(ImVec2 center, float half, ImU32 color)
        : list_(ImGui::GetWindowDrawList()), center_(center), half_(half), color_(color) {}

    [[nodiscard]] ImVec2 at(float x, float y) const {
        return {center_.x + x * half_, center_.y + y * half_};
    }
    void bar(float x, float y, float width, float height) const {
        list_->AddRectFilled(at(x, y), at(x + width, y + height), color_);
    }
    /// A triangle that points left or right, with its flat side at x.
    void arrow(float x, float tip_x, float half_height = 0.9F) const {
        list_->AddTriangleFilled(at(x, -half_height), at(tip_x, 0), at(x, half_height), color_);
    }
    void line(float x1, float y1, float x2, float y2) const {
        list_->AddLine(at(x1, y1), at(x2, y2), color_, stroke());
    }
    void diamond(float x) const {
        list_->AddQuadFilled(at(x, -0.75F), at(x + 0.55F, 0), at(x, 0.75F), at(x - 0.55F, 0),
                             color_);
    }
    /// An open ring with an arrow head.
    void ring() const {
        list_->PathArcTo(center_, 0.75F * half_, -0.3F, 4.6F, 20);
        list_->PathStroke(color_, ImDrawFlags_None, stroke());
        list_->AddTriangleFilled(at(-0.15F, -1.15F), at(0.5F, -0.72F), at(-0.15F, -0.3F), color_);
    }
    void disc(float x, float y, float radius) const {
        list_->AddCircleFilled(at(x, y), radius * half_, color_);
    }

  private:
    [[nodiscard]] float stroke() const { return std::max(1.5F, half_ * 0.28F); }

    ImDrawList* list_;
    ImVec2 center_;
    float half_;
    ImU32 color_;
};

void drawIcon(Icon icon, const IconPen& pen) {
    switch (icon) {
        case Icon::ToStart:
            pen.bar(-0.9F, -0.9F, 0.28F, 1.8F);
            pen.arrow(0.9F, -0.5F);
            break;
        case Icon::ToEnd:
            pen.bar(0.62F, -0.9F, 0.28F, 1.8F);
            pen.arrow(-0.9F, 0.5F);
            break;
        case Icon::PreviousMark:
            pen.arrow(0.05F, -1.05F, 0.8F);
            pen.diamond(0.65F);
            break;
        case Icon::NextMark:
            pen.arrow(-0.05F, 1.05F, 0.8F);
            pen.diamond(-0.65F);
            break;
        case Icon::StepBack:
            pen.arrow(0.4F, -0.75F, 0.85F);
            pen.bar(0.55F, -0.85F, 0.22F, 1.7F);
            break;
        case Icon::StepForward:
            pen.arrow(-0.4F, 0.75F, 0.85F);
            pen.bar(-0.77F, -0.85F, 0.22F, 1.7F);
            break;
        case Icon::Play:
            pen.arrow(-0.65F, 0.95F, 1.0F);
            break;
        case Icon::Pause:
            pen.bar(-0.7F, -0.9F, 0.45F, 1.8F);
            pen.bar(0.25F, -0.9F, 0.45F, 1.8F);
            break;
        case Icon::Loop:
            pen.ring();
            break;
        case Icon::Pin:
            pen.disc(0, -0.4F, 0.5F);
            pen.line(0, 0, 0, 1);
            break;
        case Icon::Grow:
            pen.line(-0.8F, 0.8F, 0.8F, -0.8F);
            pen.line(0.1F, -0.8F, 0.8F, -0.8F);
            pen.line(0.8F, -0.8F, 0.8F, -0.1F);
            pen.line(-0.8F, 0.1F, -0.8F, 0.8F);
            pen.line(-0.8F, 0.8F, -0.1F, 0.8F);
            break;
        case Icon::Float:
            pen.line(-0.9F, -0.8F, 0.9F, -0.8F);
            pen.line(0.9F, -0.8F, 0.9F, 0.8F);
            pen.line(0.9F, 0.8F, -0.9F, 0.8F);
            pen.line(-0.9F, 0.8F, -0.9F, -0.8F);
            pen.bar(0.0F, 0.0F, 0.65F, 0.55F);
            break;
        case Icon::Save:
            pen.line(0, -0.9F, 0, 0.3F);
            pen.line(-0.5F, -0.2F, 0, 0.3F);
            pen.line(0, 0.3F, 0.5F, -0.2F);
            pen.line(-0.8F, 0.8F, 0.8F, 0.8F);
            break;
        case Icon::Up:
            pen.line(-0.7F, 0.4F, 0, -0.4F);
            pen.line(0, -0.4F, 0.7F, 0.4F);
            break;
        case Icon::Down:
            pen.line(-0.7F, -0.4F, 0, 0.4F);
            pen.line(0, 0.4F, 0.7F, -0.4F);
            break;
        case Icon::Close:
            pen.line(-0.65F, -0.65F, 0.65F, 0.65F);
            pen.line(0.65F, -0.65F, -0.65F, 0.65F);
            break;
    }
}

}  // namespace

bool iconButton(Icon icon, std::string_view name, const IconOptions& options) {
    const bool enabled = options.why_not.empty();
    const float side =
        options.small ? ImGui::GetTextLineHeight() + scaled(4) : ImGui::GetFrameHeight();
    ImGui::PushID(name.data(), name.data() + name.size());
    ImGui::BeginDisabled(!enabled);
    if (options.on)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
    const bool pressed = ImGui::Button("##icon", {side, side});
    if (options.on) ImGui::PopStyleColor();
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    drawIcon(icon, IconPen({std::floor((low.x + high.x) / 2), std::floor((low.y + high.y) / 2)},
                           side * 0.26F, ImGui::GetColorU32(ImGuiCol_Text)));
    ImGui::EndDisabled();
    nameItem(name, enabled);
    tooltip(enabled ? options.tip : options.why_not);
    ImGui::PopID();
    return pressed;
}

}  // namespace dollytrack::ui
