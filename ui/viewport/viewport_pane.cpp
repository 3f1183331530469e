#include "ui/viewport/viewport_pane.h"

#include "ui/theme.h"
#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace dollytrack::ui {
namespace {

constexpr float kClickSlack_px = 4.0F;

/// The part of the pane that an image of the given aspect ratio fills.
void fitInto(ImVec2& low, ImVec2& size, double aspect) {
    if (aspect <= 0.0) return;
    const float wanted_height = size.x / static_cast<float>(aspect);
    if (wanted_height <= size.y) {
        low.y += 0.5F * (size.y - wanted_height);
        size.y = wanted_height;
    } else {
        const float wanted_width = size.y * static_cast<float>(aspect);
        low.x += 0.5F * (size.x - wanted_width);
        size.x = wanted_width;
    }
}

/// Text on a background plate; `top` is the middle of its upper edge.
void drawPlate(const std::string& text, ImVec2 top, const ImVec4& color) {
    if (text.empty()) return;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 low(top.x - 0.5F * size.x, top.y);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled({low.x - scaled(12), low.y - scaled(8)},
                        {low.x + size.x + scaled(12), low.y + size.y + scaled(8)},
                        ImGui::GetColorU32(ImGuiCol_PopupBg), scaled(6));
    list->AddText(low, ImGui::GetColorU32(color), text.c_str());
}

/// The name of the view, with a shadow, because it lies on the image.
void drawViewName(const std::string& name, ImVec2 low) {
    const ImVec2 at(low.x + scaled(10), low.y + scaled(8));
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddText({at.x + scaled(1), at.y + scaled(1)}, ImGui::GetColorU32(ImGuiCol_WindowBg),
                  name.c_str());
    list->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    nameArea("viewport.name", at.x, at.y, at.x + size.x, at.y + size.y);
}

void zoomWithWheel(const ViewportView& view, ViewportState& state, ViewportActions& actions) {
    const float wheel = ImGui::GetIO().MouseWheel;
    if (wheel == 0.0F) return;
    const render::View now = state.camera.view(actions.width, actions.height);
    const Eigen::Vector3d at = zoomCentre(view.image, now, state.camera.pivot, actions.cursor);
    state.camera.zoom(std::pow(0.88, wheel), at);
    actions.camera_moved = true;
}

/// Returns whether a key is held.
bool flyWithKeys(ViewportState& state, ViewportActions& actions) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto held = [](int plus, int minus) {
        return static_cast<double>(ImGui::IsKeyDown(plus)) - ImGui::IsKeyDown(minus);
    };
    const Eigen::Vector3d way(held(GLFW_KEY_D, GLFW_KEY_A), held(GLFW_KEY_E, GLFW_KEY_Q),
                              held(GLFW_KEY_W, GLFW_KEY_S));
    if (way.isZero()) return false;
    const double speed_mps = io.KeyShift ? 6.0 : 2.0;
    state.camera.fly(speed_mps * std::min(io.DeltaTime, 0.1F) * way);
    actions.camera_moved = true;
    return true;
}

/// Whether the left button belongs to a gizmo handle.
bool isHandles(const ViewportView& view) {
    return view.on_handle && ImGui::IsMouseDown(ImGuiMouseButton_Left);
}

void beginDrag(ViewportState& state, const ViewportView& view) {
    const ImGuiIO& io = ImGui::GetIO();
    if (view.covered || isHandles(view)) return;
    if (state.box_select && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        state.drag = ViewportState::Drag::Box;
    } else if (state.box_select && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        state.cancelBoxSelect();
        return;
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        state.drag = ViewportState::Drag::Pressed;
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
        state.drag = io.KeyShift ? ViewportState::Drag::Pan : ViewportState::Drag::Orbit;
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        state.drag = ViewportState::Drag::Look;
    } else {
        return;
    }
    state.looked = false;
    state.pressed_at = {io.MousePos.x, io.MousePos.y};
    state.pressed_with_shift = io.KeyShift;
    state.pressed_with_ctrl = io.KeyCtrl;
    state.pressed_with_alt = io.KeyAlt;
}

/// Draws the box from the press to the mouse; reports it when the button is released.
void continueBox(ViewportState& state, ViewportActions& actions) {
    const Eigen::Vector2d origin = actions.origin.cast<double>();
    const Eigen::Vector2d size(actions.width, actions.height);
    Eigen::AlignedBox2d box(Eigen::Vector2d(state.pressed_at - origin));
    box.extend(actions.cursor);
    box = box.intersection(Eigen::AlignedBox2d(Eigen::Vector2d(0.0, 0.0), size));
    const auto corner = [&](const Eigen::Vector2d& pixel) {
        return ImVec2(static_cast<float>(pixel.x() + origin.x()),
                      static_cast<float>(pixel.y() + origin.y()));
    };
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(corner(box.min()), corner(box.max()), IM_COL32(255, 255, 255, 25));
    list->AddRect(corner(box.min()), corner(box.max()), IM_COL32(255, 255, 255, 200));
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    actions.box = box;
    actions.add_to_selection = state.pressed_with_shift;
    actions.remove_from_selection = state.pressed_with_ctrl;
    state.cancelBoxSelect();
}

/// Lines through the mouse while a box is about to be drawn.
void drawCrosshair(const ViewportActions& actions) {
    const ImVec2 low(actions.origin.x(), actions.origin.y());
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const ImU32 color = IM_COL32(255, 255, 255, 120);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddLine({low.x, mouse.y}, {low.x + static_cast<float>(actions.width), mouse.y}, color);
    list->AddLine({mouse.x, low.y}, {mouse.x, low.y + static_cast<float>(actions.height)}, color);
}

void continueDrag(ViewportState& state, const ViewportView& view, ViewportActions& actions) {
    using Drag = ViewportState::Drag;
    if (state.drag == Drag::Box) return continueBox(state, actions);
    const ImGuiIO& io = ImGui::GetIO();
    const bool beyond_click =
        (Eigen::Vector2d(io.MousePos.x, io.MousePos.y) - state.pressed_at).norm() >
        scaled(kClickSlack_px);
    if (state.drag == Drag::Pressed && beyond_click) {
        state.drag = state.pressed_with_shift ? Drag::Pan : Drag::Orbit;
    }
    if (state.drag == Drag::Look && beyond_click) state.looked = true;
    const double dx = io.MouseDelta.x;
    const double dy = io.MouseDelta.y;
    const bool may_click =
        state.drag == Drag::Pressed || (state.drag == Drag::Look && !state.looked);
    const bool moves = (dx != 0.0 || dy != 0.0) && !may_click;
    if (view.locked) {
        actions.unlock = moves;
    } else if (moves) {
        if (state.drag == Drag::Orbit) state.camera.orbit(dx, dy);
        if (state.drag == Drag::Pan) state.camera.pan(dx, dy, actions.width);
        if (state.drag == Drag::Look) state.camera.look(dx, dy);
        actions.camera_moved = true;
    }
    if (state.drag == Drag::Look && !view.locked && flyWithKeys(state, actions)) {
        state.looked = true;
    }
    if (!ImGui::IsAnyMouseDown()) {
        if (state.drag == Drag::Pressed) {
            actions.clicked = actions.cursor;
            actions.add_to_selection = state.pressed_with_ctrl || state.pressed_with_shift;
            actions.list = state.pressed_with_alt;
        }
        if (state.drag == Drag::Look && !state.looked) actions.right_clicked = actions.cursor;
        state.drag = Drag::None;
    }
}

}  // namespace

namespace {

/// Converts a pane position to pixels of the image, which may be smaller.
std::optional<std::size_t> placeOf(const ViewImage& image, const Eigen::Vector2d& pixel) {
    if (image.serial == 0) return {};
    const Intrinsics& pane = image.view.intrinsics;
    const int x = static_cast<int>(std::floor(pixel.x() * image.width / pane.width));
    const int y = static_cast<int>(std::floor(pixel.y() * image.height / pane.height));
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return {};
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
           static_cast<std::size_t>(x);
}

}  // namespace

std::optional<Eigen::Vector3d> surfaceAt(const ViewImage& image, const Eigen::Vector2d& pixel) {
    const auto place = placeOf(image, pixel);
    const double depth = place ? image.depth_m[*place] : 0.0;
    if (depth <= 0.0) return {};
    const render::ViewRay ray = image.view.rayThrough(pixel.x(), pixel.y());
    return ray.origin + depth * ray.direction;
}

Eigen::Vector3d zoomCentre(const ViewImage* image, const render::View& current,
                           const Eigen::Vector3d& pivot, const Eigen::Vector2d& cursor) {
    constexpr double kStill_px = 3.0;  // more than rounding, less than any jump of the camera
    if (const auto surface = image != nullptr ? surfaceAt(*image, cursor) : std::nullopt) {
        const Eigen::Vector3d in_camera = current.pose.toCamera(*surface);
        if (in_camera.z() > 0.0 && (current.project(in_camera) - cursor).norm() < kStill_px) {
            return *surface;
        }
    }
    const render::ViewRay ray = current.rayThrough(cursor.x(), cursor.y());
    const double depth = (pivot - ray.origin).dot(current.pose.forward());
    return ray.origin + depth * ray.direction;
}

std::vector<int> objectsIn(const ViewImage& image, const Eigen::AlignedBox2d& pixels) {
    if (image.serial == 0 || pixels.isEmpty()) return {};
    const Intrinsics& pane = image.view.intrinsics;
    const Eigen::Array2d scale(static_cast<double>(image.width) / pane.width,
                               static_cast<double>(image.height) / pane.height);
    const Eigen::Array2i most(image.width - 1, image.height - 1);
    const auto place = [&](const Eigen::Vector2d& pixel) -> Eigen::Array2i {
        return (pixel.array() * scale).floor().cast<int>().max(0).min(most);
    };
    const Eigen::Array2i low = place(pixels.min());
    const Eigen::Array2i high = place(pixels.max());
    std::set<int> ids;
    for (int y = low.y(); y <= high.y(); ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * image.width;
        for (int x = low.x(); x <= high.x(); ++x) ids.insert(image.ids[row + x]);
    }
    ids.erase(0);
    return {ids.begin(), ids.end()};
}

bool ViewportState::cancelBoxSelect() {
    if (drag == Drag::Box) drag = Drag::None;
    return std::exchange(box_select, false);
}

int objectAt(const ViewImage& image, const Eigen::Vector2d& pixel) {
    const auto place = placeOf(image, pixel);
    return place ? image.ids[*place] : 0;
}

ViewportActions drawViewport(const ViewportView& view, ViewportState& state) {
    ViewportActions actions;
    ImVec2 low = ImGui::GetCursorScreenPos();
    ImVec2 size = ImGui::GetContentRegionAvail();
    size = {std::max(size.x, 16.0F), std::max(size.y, 16.0F)};
    const ImVec2 pane_low = low;
    const ImVec2 pane_high = {low.x + size.x, low.y + size.y};
    fitInto(low, size, view.aspect);
    actions.width = static_cast<int>(size.x);
    actions.height = static_cast<int>(size.y);
    actions.origin = {low.x, low.y};

    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(pane_low, pane_high,
                        ImGui::GetColorU32(ImGui::GetStyle().Colors[ImGuiCol_MenuBarBg]));
    if (view.image != nullptr && view.image->serial != 0) {
        list->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(  // NOLINT
                           view.image->texture)),
                       low, {low.x + size.x, low.y + size.y});
    }
    const float centre = 0.5F * (pane_low.x + pane_high.x);
    const float half_line = 0.5F * ImGui::GetTextLineHeight();
    drawPlate(view.message, {centre, 0.5F * (pane_low.y + pane_high.y) - half_line},
              ImGui::GetStyleColorVec4(ImGuiCol_Text));
    drawPlate(view.remark, {centre, pane_low.y + scaled(18)}, palette().warning);
    if (!view.remark.empty()) {
        nameArea("viewport.remark", centre - 3, pane_low.y + scaled(18), centre + 3,
                 pane_low.y + scaled(18) + 2 * half_line);
    }
    if (view.image != nullptr && !view.name.empty()) drawViewName(view.name, low);
    ImGui::SetCursorScreenPos(low);
    ImGui::InvisibleButton("viewport", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::SetItemAllowOverlap();
    nameItem("viewport");
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    actions.hovered = ImGui::IsItemHovered();
    actions.cursor = {mouse.x - low.x, mouse.y - low.y};
    if (actions.hovered) {
        beginDrag(state, view);
        actions.double_clicked = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        if (!view.covered && !view.locked && !isHandles(view)) zoomWithWheel(view, state, actions);
    }
    if (state.box_select && actions.hovered) drawCrosshair(actions);
    if (state.drag != ViewportState::Drag::None) continueDrag(state, view, actions);
    return actions;
}

}  // namespace dollytrack::ui
