#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::ui {

/// Where a named widget is on the screen, in window pixels, clipped to what is visible of it.
struct NamedItem {
    std::string name;  // "parameters.fill", "menu.file.open"
    float left = 0, top = 0, right = 0, bottom = 0;
    bool enabled = true;
};

/// Names the widget drawn last, so that scripts can find it and click it as a person would. Does
/// nothing unless the map is wanted. Like ImGui itself it works on the current context.
void nameItem(std::string_view name, bool enabled = true);
/// The same for a rectangle of one's own drawing.
void nameArea(std::string_view name, float left, float top, float right, float bottom);

namespace item_map {
void want(bool wanted);
void beginFrame();
/// Of the last whole frame.
const std::vector<NamedItem>& items();
void endFrame();
}  // namespace item_map

}  // namespace dollytrack::ui
