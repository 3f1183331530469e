#include "ui/widgets/fields/class_combo.h"

#include "engine/scene/labels.h"
#include "ui/theme.h"
#include "ui/widgets/fuzzy_match.h"
#include "ui/widgets/item_map.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <vector>

namespace dollytrack::ui {
namespace {

std::vector<int> classesFor(const std::string& filter) {
    std::vector<std::pair<int, int>> found;  // score, class id
    for (int nyu40 = 1; nyu40 <= kNyu40Count; ++nyu40) {
        if (const auto match = fuzzyMatch(filter, nyu40Name(nyu40))) {
            found.emplace_back(filter.empty() ? 0 : match->score, nyu40);
        }
    }
    std::ranges::stable_sort(found, std::ranges::greater{}, &std::pair<int, int>::first);
    std::vector<int> classes;
    for (const auto& [score, nyu40] : found) classes.push_back(nyu40);
    return classes;
}

void drawSwatch(int nyu40) {
    const auto color = nyu40Color(nyu40);
    const float size = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + size * 0.15F},
                                              {at.x + size * 0.7F, at.y + size * 0.85F},
                                              IM_COL32(color[0], color[1], color[2], 255), 2.0F);
    ImGui::Dummy({size * 0.7F, size});
    ImGui::SameLine();
}

}  // namespace

std::optional<int> classCombo(std::optional<int> nyu40, std::string& filter,
                              const std::string& name) {
    std::optional<int> chosen;
    std::string shown = "various";
    if (nyu40) shown = *nyu40 == 0 ? "unknown" : std::string(nyu40Name(*nyu40));
    const bool open =
        ImGui::BeginCombo(("##" + name).c_str(), shown.c_str(), ImGuiComboFlags_HeightLarge);
    if (!open) {
        nameItem(name);
        return chosen;
    }
    if (ImGui::IsWindowAppearing()) {
        filter.clear();
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-1);
    const bool entered = ImGui::InputTextWithHint("##filter", "Find a class", &filter,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    nameItem(name + ".filter");
    const std::vector<int> classes = classesFor(filter);
    if (classes.empty()) ImGui::TextDisabled("No match.");
    for (const int candidate : classes) {
        ImGui::PushID(candidate);
        drawSwatch(candidate);
        if (ImGui::Selectable(std::string(nyu40Name(candidate)).c_str(), candidate == nyu40)) {
            chosen = candidate;
        }
        nameItem(name + "." + std::to_string(candidate));
        ImGui::PopID();
    }
    if (entered && !classes.empty()) {
        chosen = classes.front();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndCombo();
    if (chosen == nyu40) chosen.reset();
    return chosen;
}

}  // namespace dollytrack::ui
