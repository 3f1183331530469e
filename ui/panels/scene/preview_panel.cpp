#include "ui/panels/scene/preview_panel.h"

#include "engine/scene/labels.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/icon_button.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace dollytrack::ui {
namespace {

constexpr std::array kModalities = {Modality::Rgb, Modality::Depth, Modality::Instance,
                                    Modality::Semantic, Modality::Normal};
constexpr float kMargin = 10.0F;
constexpr float kNarrowest = 290.0F;
constexpr float kNarrowestTitle = 312.0F;
constexpr float kListWidth = 86.0F;
constexpr float kTitleMargin = 10.0F;

bool isLeft(PaneCorner corner) {
    return corner == PaneCorner::TopLeft || corner == PaneCorner::BottomLeft;
}

bool isTop(PaneCorner corner) {
    return corner == PaneCorner::TopLeft || corner == PaneCorner::TopRight;
}

PaneCorner cornerOf(bool left, bool top) {
    if (left) return top ? PaneCorner::TopLeft : PaneCorner::BottomLeft;
    return top ? PaneCorner::TopRight : PaneCorner::BottomRight;
}

double aspectOf(const PreviewView& view) {
    const bool drawn = view.image != nullptr && view.image->record.height > 0;
    return drawn ? double(view.image->record.width) / view.image->record.height : 4.0 / 3.0;
}

struct Frame {
    ImVec2 low, size;  // including the title bar
    ImVec2 picture;    // size of the image
};

/// Position of the panel and size of its image.
Frame layOut(const PreviewView& view, const PreviewState& state, float title) {
    const ImVec2 pane(view.high.x - view.low.x, view.high.y - view.low.y);
    const auto aspect = static_cast<float>(aspectOf(view));
    Frame frame;
    if (state.full || view.docked) {
        frame.low = view.low;
        frame.size = pane;
        const float height = std::min(pane.y - title, pane.x / aspect);
        frame.picture = {std::floor(height * aspect), std::floor(height)};
        return frame;
    }
    const float margin = scaled(kMargin);
    // The chosen width applies to the longer side; otherwise a portrait image would cover half of
    // the viewport.
    const float side = std::min(scaled(std::max(state.width, kNarrowest)), pane.x - 2 * margin);
    const float room = std::max(pane.y - 2 * margin - title, 1.0F);
    const float width = std::max(std::min(side * std::min(aspect, 1.0F), room * aspect), 1.0F);
    frame.picture = {std::floor(width), std::floor(width / aspect)};
    // The title bar keeps a minimum width, even above a narrow image.
    frame.size = {std::max(frame.picture.x, std::min(scaled(kNarrowestTitle), pane.x - 2 * margin)),
                  title + (state.open ? frame.picture.y : 0.0F)};
    frame.low.x = isLeft(state.corner) ? view.low.x + margin : view.high.x - margin - frame.size.x;
    frame.low.y = isTop(state.corner) ? view.low.y + margin : view.high.y - margin - frame.size.y;
    // The title bar must stay reachable for folding and dragging.
    frame.low.y = std::max(frame.low.y, view.low.y);
    return frame;
}

void drawModality(PreviewState& state, PreviewActions& actions) {
    ImGui::SetNextItemWidth(scaled(kListWidth));
    const bool open = ImGui::BeginCombo("##modality", modalityName(state.modality));
    nameItem("preview.modality");
    if (!open) return;
    for (const Modality modality : kModalities) {
        if (ImGui::Selectable(modalityName(modality), modality == state.modality)) {
            actions.changed = actions.changed || modality != state.modality;
            state.modality = modality;
        }
        nameItem(std::string("preview.modality.") + modalityName(modality));
    }
    ImGui::EndCombo();
}

/// The title bar; dragging it moves the panel to another corner.
void drawHandle(const PreviewView& view, PreviewState& state, float width) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    ImGui::InvisibleButton("handle", {std::max(width, 1.0F), height});
    nameItem("preview.title");
    if (!state.full) {
        tooltip(view.what + (view.docked ? "\nDouble click to fold."
                                         : "\nDrag to another corner; double click to fold."));
        if (!view.docked && ImGui::IsItemActive() &&
            ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
            const ImVec2 mouse = ImGui::GetIO().MousePos;
            state.corner = cornerOf(mouse.x < (view.low.x + view.high.x) / 2,
                                    mouse.y < (view.low.y + view.high.y) / 2);
        }
        if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            state.open = !state.open;
        }
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect(low, {low.x + width, low.y + height}, true);
    list->AddText({low.x, low.y + ImGui::GetStyle().FramePadding.y},
                  ImGui::GetColorU32(view.busy ? palette().text_dim
                                               : ImGui::GetStyleColorVec4(ImGuiCol_Text)),
                  cutToWidth(view.what, width).c_str());
    list->PopClipRect();
}

void drawTitle(const PreviewView& view, PreviewState& state, PreviewActions& actions) {
    const float gap = scaled(3);
    const float icon = ImGui::GetFrameHeight();
    const float tools =
        scaled(kListWidth) + (state.full ? 3.0F : 5.0F) * icon + 6 * gap + scaled(8);
    drawHandle(view, state, ImGui::GetContentRegionAvail().x - tools);
    ImGui::SameLine(0, gap);
    drawModality(state, actions);
    ImGui::SameLine(0, gap);
    const bool pinned = state.shows_selection;
    if (iconButton(
            Icon::Pin, "preview.pin",
            {pinned ? "Shows the selected position point; click to follow the timeline"
                    : "Follows the timeline; click to show the selected position point",
             pinned || view.point_selected ? "" : "Select a position point to show its view.",
             pinned})) {
        state.shows_selection = !pinned;
        actions.changed = true;
    }
    ImGui::SameLine(0, gap);
    if (iconButton(Icon::Save, "preview.save", {"Save this image as a PNG file", view.why_not})) {
        actions.save_png = true;
    }
    ImGui::SameLine(0, gap);
    if (iconButton(
            Icon::Grow, "preview.full",
            {state.full ? "Back to its place" : "Over the whole viewport", {}, state.full})) {
        state.full = !state.full;
        state.open = true;
    }
    if (state.full) return;
    ImGui::SameLine(0, gap);
    if (iconButton(Icon::Float, "preview.dock",
                   {state.docked ? "Float over the viewport" : "Dock beside the timeline",
                    {},
                    !state.docked})) {
        state.docked = !state.docked;
    }
    ImGui::SameLine(0, gap);
    const bool folded = !state.open;
    if (iconButton(folded ? Icon::Up : Icon::Down, "preview.fold", {folded ? "Unfold" : "Fold"})) {
        state.open = folded;
    }
}

/// Texts for a pixel, independent of the shown modality: position, depth and colour; then object
/// and class.
std::array<std::string, 2> valuesOf(const PreviewView& view, ImagePixel pixel) {
    const render::FrameRecord& record = view.image->record;
    const auto i = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(record.width) +
                   static_cast<std::size_t>(pixel.x);
    std::string numbers = fmt::format("{}, {}", pixel.x, pixel.y);
    if (i < record.depth_m.size()) {
        numbers += record.depth_m[i] > 0.0F ? fmt::format("   {:.4f} m", record.depth_m[i])
                                            : "   no surface";
    }
    if (3 * i + 2 < record.rgb.size()) {
        const std::uint8_t* rgb = &record.rgb[3 * i];
        numbers += fmt::format("   rgb {}, {}, {}", rgb[0], rgb[1], rgb[2]);
    }
    std::string names;
    const int id = i < record.instance.size() ? record.instance[i] : 0;
    if (id > 0 && view.scene != nullptr && id <= static_cast<int>(view.scene->objects.size())) {
        names = fmt::format("{} (object {})", view.scene->object(id).name, id);
    }
    const ClassTable& classes = record.classes();
    const DatasetClass* label =
        i < record.semantic.size() ? classes.find(record.semantic[i]) : nullptr;
    if (label != nullptr && label != &classes.voidClass()) {
        names += fmt::format("{}{} (class {})", names.empty() ? "" : ", ", label->name, label->id);
    }
    return {numbers, names};
}

/// Draws the values along the top or bottom edge of the image, away from the mouse.
void drawValues(const PreviewView& view, ImagePixel pixel, ImVec2 low, ImVec2 size) {
    const std::array<std::string, 2> lines = valuesOf(view, pixel);
    const float pad = scaled(4);
    const float line = ImGui::GetTextLineHeight();
    const float height = (lines[1].empty() ? 1.0F : 2.0F) * line + pad;
    const bool at_top = ImGui::GetIO().MousePos.y > low.y + 0.5F * size.y;
    const float top = at_top ? low.y : low.y + size.y - height;
    ImDrawList* list = ImGui::GetWindowDrawList();
    ImVec4 back = ImGui::GetStyleColorVec4(ImGuiCol_PopupBg);
    back.w = 0.85F;
    list->AddRectFilled({low.x, top}, {low.x + size.x, top + height}, ImGui::GetColorU32(back));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string text = cutToWidth(lines[i], size.x - 2 * pad, Cut::Middle);
        list->AddText({low.x + pad, top + 0.5F * pad + static_cast<float>(i) * line},
                      ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    }
    nameArea("preview.values", low.x, top, low.x + size.x, top + height);
}

void drawPicture(const PreviewView& view, ImVec2 size) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    if (view.image == nullptr || view.image->texture == 0 || !view.why_not.empty()) {
        ImGui::Dummy(size);
        const std::string text = !view.why_not.empty() ? view.why_not : "Drawing …";
        const float wrap = size.x - scaled(24);
        const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
        ImGui::SetCursorScreenPos({low.x + std::max(scaled(12), (size.x - extent.x) / 2),
                                   low.y + (size.y - extent.y) / 2});
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
        ImGui::TextColored(palette().text_dim, "%s", text.c_str());
        ImGui::PopTextWrapPos();
        return;
    }
    ImGui::Image(reinterpret_cast<ImTextureID>(std::uintptr_t{view.image->texture}), size);
    nameItem("preview.picture");
    const auto& record = view.image->record;
    const auto pixel = pixelAt(ImGui::GetIO().MousePos, low, size, record.width, record.height);
    if (pixel && ImGui::IsItemHovered()) drawValues(view, *pixel, low, size);
}

/// The resize handle, at the corner that points into the viewport.
void drawGrip(PreviewState& state, const Frame& frame) {
    const float side = scaled(14);
    const float x = isLeft(state.corner) ? frame.low.x + frame.size.x - side : frame.low.x;
    const float y = isTop(state.corner) ? frame.low.y + frame.size.y - side : frame.low.y;
    ImGui::SetCursorScreenPos({x, y});
    ImGui::InvisibleButton("grip", {side, side});
    nameItem("preview.grip");
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot) {
        const bool falling = isLeft(state.corner) == isTop(state.corner);
        ImGui::SetMouseCursor(falling ? ImGuiMouseCursor_ResizeNWSE : ImGuiMouseCursor_ResizeNESW);
    }
    if (ImGui::IsItemActive()) {
        const float dx = ImGui::GetIO().MouseDelta.x / scaled(1);
        state.width = std::max(state.width, kNarrowest) + (isLeft(state.corner) ? dx : -dx);
        state.width = std::clamp(state.width, kNarrowest, 4000.0F);
    }
    const ImU32 color = ImGui::GetColorU32(hot ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled);
    const float right = isLeft(state.corner) ? x + side : x;
    const float inner_x = isLeft(state.corner) ? x : x + side;
    const float outer_y = isTop(state.corner) ? y + side : y;
    const float inner_y = isTop(state.corner) ? y : y + side;
    ImGui::GetWindowDrawList()->AddTriangleFilled({right, outer_y},
                                                  {(right + inner_x) / 2, outer_y},
                                                  {right, (outer_y + inner_y) / 2}, color);
}

}  // namespace

const char* modalityName(Modality modality) {
    switch (modality) {
        case Modality::Rgb:
            return "rgb";
        case Modality::Depth:
            return "depth";
        case Modality::Instance:
            return "instance";
        case Modality::Semantic:
            return "semantic";
        case Modality::Normal:
            break;
    }
    return "normal";
}

std::optional<ImagePixel> pixelAt(ImVec2 mouse, ImVec2 low, ImVec2 size, int width, int height) {
    if (size.x <= 0 || size.y <= 0) return std::nullopt;
    const int x = static_cast<int>(std::floor((mouse.x - low.x) * float(width) / size.x));
    const int y = static_cast<int>(std::floor((mouse.y - low.y) * float(height) / size.y));
    if (x < 0 || y < 0 || x >= width || y >= height) return std::nullopt;
    return ImagePixel{x, y};
}

PreviewActions drawPreviewPanel(const PreviewView& view, PreviewState& state) {
    PreviewActions actions;
    const float pad = scaled(5);
    const Frame frame = layOut(view, state, ImGui::GetFrameHeight() + 2 * pad);
    ImGui::SetCursorScreenPos(frame.low);
    ImVec4 back = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    back.w = state.full || view.docked ? 1.0F : 0.94F;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, back);
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, state.full || view.docked ? 0.0F : scaled(5));
    // The viewport's window has no padding; combo lists and tooltips need some.
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(10), scaled(8)});
    ImGui::BeginChild("preview", frame.size, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    actions.hovered = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    ImGui::SetCursorScreenPos({frame.low.x + scaled(kTitleMargin), frame.low.y + pad});
    ImGui::BeginGroup();
    ImGui::PushClipRect(frame.low, {frame.low.x + frame.size.x - pad, frame.low.y + frame.size.y},
                        true);
    drawTitle(view, state, actions);
    ImGui::PopClipRect();
    ImGui::EndGroup();
    if (state.open || state.full) {
        const float title = ImGui::GetFrameHeight() + 2 * pad;
        ImGui::SetCursorScreenPos(
            {frame.low.x + std::floor((frame.size.x - frame.picture.x) / 2), frame.low.y + title});
        drawPicture(view, frame.picture);
    }
    if (state.open && !state.full && !view.docked) drawGrip(state, frame);
    if (!state.full && !view.docked) {
        ImGui::GetWindowDrawList()->AddRect(
            frame.low, {frame.low.x + frame.size.x, frame.low.y + frame.size.y},
            ImGui::GetColorU32(palette().panel_line), scaled(5));
    }
    ImGui::EndChild();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
    return actions;
}

}  // namespace dollytrack::ui
