#include "ui/widgets/fields/choice_combo.h"

#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <string>

namespace dollytrack::ui {

bool choiceCombo(const char* name, int& chosen, std::span<const char* const> entries) {
    const int before = chosen;
    const std::string label = std::string("##") + name;
    const bool open = ImGui::BeginCombo(label.c_str(), entries[chosen]);
    nameItem(name);
    if (!open) return false;
    for (int i = 0; i < static_cast<int>(entries.size()); ++i) {
        if (ImGui::Selectable(entries[i], i == before)) chosen = i;
        nameItem(std::string(name) + "." + std::to_string(i));
    }
    ImGui::EndCombo();
    return chosen != before;
}

}  // namespace dollytrack::ui
