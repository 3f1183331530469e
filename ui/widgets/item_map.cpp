#include "ui/widgets/item_map.h"

#include "ui/widgets/cut_lines.h"

#include <imgui.h>

#include <algorithm>

namespace dollytrack::ui {
namespace {

struct Map {
    bool wanted = false;
    std::vector<NamedItem> building;
    std::vector<NamedItem> finished;
};

Map& map() {
    static Map the_map;
    return the_map;
}

}  // namespace

void nameItem(std::string_view name, bool enabled) {
    if (!map().wanted) return;
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    const ImVec2 clip_low = ImGui::GetWindowDrawList()->GetClipRectMin();
    const ImVec2 clip_high = ImGui::GetWindowDrawList()->GetClipRectMax();
    const NamedItem item{std::string(name),
                         std::max(low.x, clip_low.x),
                         std::max(low.y, clip_low.y),
                         std::min(high.x, clip_high.x),
                         std::min(high.y, clip_high.y),
                         enabled};
    if (item.left < item.right && item.top < item.bottom) map().building.push_back(item);
}

void nameArea(std::string_view name, float left, float top, float right, float bottom) {
    if (!map().wanted) return;
    map().building.push_back({std::string(name), left, top, right, bottom, true});
}

namespace item_map {

void want(bool wanted) {
    map().wanted = wanted;
}

void beginFrame() {
    map().building.clear();
}

void endFrame() {
    map().finished.swap(map().building);
    noteCutLines();
}

const std::vector<NamedItem>& items() {
    return map().finished;
}

}  // namespace item_map
}  // namespace dollytrack::ui
