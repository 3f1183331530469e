#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::ui {

/// Screen rectangle of a named widget, in window pixels, clipped to its visible part.
struct NamedItem {
    std::string name;  // "parameters.fill", "menu.file.open"
    float left = 0, top = 0, right = 0, bottom = 0;
    bool enabled = true;
};

/// Records the previous widget under a name, so that scripts can find and click it. Does nothing
/// unless the map is enabled. Like ImGui, it works on the current context.
void nameItem(std::string_view name, bool enabled = true);
/// Records a custom-drawn rectangle, in window pixels.
void nameArea(std::string_view name, float left, float top, float right, float bottom);

namespace item_map {
void want(bool wanted);
void beginFrame();
/// Widgets of the last completed frame.
const std::vector<NamedItem>& items();
void endFrame();
}  // namespace item_map

}  // namespace dollytrack::ui
