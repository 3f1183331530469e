#include "ui/panels/scene/image_viewer.h"

#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace dollytrack::ui {
namespace {

constexpr double kClosest = 32.0;

double fitZoom(const ImageViewerView& view, ImVec2 pane) {
    return std::min(double(pane.x) / view.width, double(pane.y) / view.height);
}

/// Placement of the image in its pane.
struct Placement {
    double zoom;
    double left, top;  // edges of the image, px on the screen
};

Placement place(const ImageViewerView& view, const ImageViewerState& state, ImVec2 low,
                ImVec2 pane) {
    const double fit = fitZoom(view, pane);
    const double zoom = state.zoom > 0.0 ? state.zoom : fit;
    const double x = state.zoom > 0.0 ? state.center_x : 0.5;
    const double y = state.zoom > 0.0 ? state.center_y : 0.5;
    return {zoom, low.x + pane.x / 2 - x * view.width * zoom,
            low.y + pane.y / 2 - y * view.height * zoom};
}

void moveWithMouse(const ImageViewerView& view, ImageViewerState& state, ImVec2 low, ImVec2 pane) {
    const ImGuiIO& io = ImGui::GetIO();
    const Placement before = place(view, state, low, pane);
    if (ImGui::IsItemHovered() && io.MouseWheel != 0.0F) {
        const double fit = fitZoom(view, pane);
        const double zoom = std::clamp(before.zoom * std::pow(1.25, double(io.MouseWheel)),
                                       std::min(fit, 1.0), kClosest);
        // Keeps the image position under the mouse in place.
        const double x = (io.MousePos.x - before.left) / before.zoom;
        const double y = (io.MousePos.y - before.top) / before.zoom;
        state.center_x = (x + (low.x + pane.x / 2 - io.MousePos.x) / zoom) / view.width;
        state.center_y = (y + (low.y + pane.y / 2 - io.MousePos.y) / zoom) / view.height;
        state.zoom = zoom <= fit ? 0.0 : zoom;
    }
    const bool dragged = ImGui::IsItemActive() && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0);
    if (dragged && state.zoom > 0.0) {
        state.center_x -= io.MouseDelta.x / state.zoom / view.width;
        state.center_y -= io.MouseDelta.y / state.zoom / view.height;
    }
    state.center_x = std::clamp(state.center_x, 0.0, 1.0);
    state.center_y = std::clamp(state.center_y, 0.0, 1.0);
}

}  // namespace

ImageViewerActions drawImageViewer(const ImageViewerView& view, ImageViewerState& state) {
    ImageViewerActions actions;
    const bool any = view.texture != 0 && view.width > 0 && view.height > 0;
    if (button("Back", "image.close", {{}, "Close this image (Esc)"})) actions.close = true;
    ImGui::SameLine();
    const std::string none = any ? "" : "There is no image.";
    if (button("Fit", "image.fit", {none, "Fit to the window"})) state.zoom = 0.0;
    ImGui::SameLine();
    if (button("1:1", "image.actual", {none, "One image pixel per screen pixel"})) {
        if (state.zoom <= 0.0) state.center_x = state.center_y = 0.5;
        state.zoom = 1.0;
    }
    ImGui::SameLine();
    ImGui::TextUnformatted(view.title.c_str());
    if (any) {
        ImGui::SameLine();
        ImGui::TextColored(palette().text_dim, "%d × %d px", view.width, view.height);
    }
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 pane(std::max(room.x, 1.0F), std::max(room.y, 1.0F));
    if (!any) {
        paragraph(view.message, palette().text_dim);
        return actions;
    }
    ImGui::InvisibleButton("pane", pane,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    nameItem("image.pane");
    moveWithMouse(view, state, low, pane);
    const Placement now = place(view, state, low, pane);
    const ImVec2 corner(std::floor(float(now.left)), std::floor(float(now.top)));
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect(low, {low.x + pane.x, low.y + pane.y}, true);
    list->AddImage(
        reinterpret_cast<ImTextureID>(std::uintptr_t{view.texture}), corner,
        {corner.x + float(view.width * now.zoom), corner.y + float(view.height * now.zoom)});
    list->PopClipRect();
    return actions;
}

}  // namespace dollytrack::ui
