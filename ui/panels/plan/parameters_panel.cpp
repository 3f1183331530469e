#include "ui/panels/plan/parameters_panel.h"

#include "ui/theme.h"
#include "ui/widgets/fields/field_editor.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"
#include "ui/widgets/text_match.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

namespace dollytrack::ui {
namespace {

std::string sectionTitle(std::string section) {
    std::ranges::replace(section, '_', ' ');
    if (!section.empty()) section.front() = static_cast<char>(std::toupper(section.front()));
    return section;
}

bool matches(const Field& field, const std::string& filter) {
    if (filter.empty()) return true;
    const auto contains = [&](std::string_view text) { return containsIgnoringCase(text, filter); };
    return contains(field.name) || contains(readableName(field)) || contains(field.text()) ||
           contains(field.symbol()) || contains(field.section);
}

}  // namespace

ParametersActions drawParametersPanel(const ParametersView& view, const FieldList& draft) {
    ParametersActions actions;
    const float reset_width = ImGui::CalcTextSize("Reset all").x + scaled(16);
    ImGui::SetNextItemWidth(-(reset_width + ImGui::GetStyle().ItemSpacing.x));
    ImGui::InputTextWithHint("##filter", "Find a parameter", view.filter);
    nameItem("parameters.filter");
    ImGui::SameLine();
    if (ImGui::Button("Reset all")) actions.reset_all = true;
    nameItem("parameters.reset_all");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Reset every parameter to its default");

    ImGui::BeginChild("fields");
    std::string section;
    bool open = false;
    bool table = false;
    for (std::size_t i = 0; i < draft.size(); ++i) {
        const Field& field = draft[i];
        if (!matches(field, *view.filter)) continue;
        if (field.section != section) {
            if (table) ImGui::EndTable();
            section = field.section;
            ImGui::PushFont(fonts().bold);
            ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyle().Colors[ImGuiCol_FrameBg]);
            open = ImGui::CollapsingHeader(sectionTitle(section).c_str(),
                                           ImGuiTreeNodeFlags_DefaultOpen);
            ImGui::PopStyleColor();
            ImGui::PopFont();
            nameItem("parameters.section." + section);
            table = open && ImGui::BeginTable(section.c_str(), 2);
            if (table) {
                ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.46F);
                ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.54F);
            }
        }
        if (!table) continue;
        const auto note = view.notes.find(field.name);
        const FieldEdit edit = drawField(field, (*view.standard)[i], "parameters." + field.name,
                                         {withoutEffectBy(draft, field),
                                          note != view.notes.end() ? note->second : std::string()});
        if (edit.changed || edit.finished) {
            actions.edited = field.name;
            actions.finished = actions.finished || edit.finished;
        }
    }
    if (table) ImGui::EndTable();
    if (section.empty()) paragraph("No parameter matches.", palette().text_dim);
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
