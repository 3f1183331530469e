#include "ui/panels/export/export_contents.h"

#include "ui/panels/export/export_draft.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>

namespace dollytrack::ui {
namespace {

constexpr const char* kModified = ", modified";

float textWidth(const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x;
}

/// The name of the chosen preset, with the width of the longest one, so that the widgets beside it
/// stay at their positions.
void drawPresetName(const ExportView& view, const ExportDraft& draft) {
    float width = 0.0F;
    for (const ExportPresetChoice& one : view.presets) {
        width = std::max(width, textWidth(one.title + kModified));
    }
    const std::string changes = changesOfPreset(view, draft);
    const std::string title = chosenPreset(view, draft)->title;
    const float left = ImGui::GetCursorPosX();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(palette().text_dim, "Preset");
    ImGui::SameLine();
    const float beside = ImGui::GetCursorPosX() - left;
    ImGui::TextColored(changes.empty() ? palette().text_dim : palette().accent, "%s",
                       (title + (changes.empty() ? "" : kModified)).c_str());
    nameItem(changes.empty() ? "export.preset" : "export.preset_modified");
    tooltip(changes.empty() ? chosenPreset(view, draft)->text
                            : "Changed since the preset was chosen: " + changes);
    ImGui::SameLine(left + beside + width + ImGui::GetStyle().ItemSpacing.x);
}

void drawPresetButtons(const ExportView& view, ExportDraft& draft, bool same_line) {
    const std::string name = chosenPreset(view, draft)->name;
    for (std::size_t i = 0; i < view.presets.size(); ++i) {
        const ExportPresetChoice& preset = view.presets[i];
        if (i > 0 && !same_line) flowTo(preset.title.c_str());
        if (i > 0 && same_line) ImGui::SameLine();
        const bool chosen = preset.name == name;
        if (chosen) {
            ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
        }
        if (button(preset.title.c_str(), "export.preset." + preset.name, {.tip = preset.text})) {
            choosePreset(view, preset, draft);
        }
        if (chosen) ImGui::PopStyleColor();
    }
}

void drawSearch(ExportDraft& draft) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##filter", "Find a modality or format", &draft.filter);
    nameItem("export.filter");
}

void drawChoice(const ExportChoice& choice, const char* kind, std::vector<std::string>& turned) {
    bool wanted = isWritten(choice, turned);
    ImGui::BeginDisabled(!choice.why_not.empty());
    if (ImGui::Checkbox(choice.name.c_str(), &wanted)) {
        if (wanted == choice.standard) {
            std::erase(turned, choice.name);
        } else {
            turned.push_back(choice.name);
        }
    }
    ImGui::EndDisabled();
    nameItem(fmt::format("export.{}.{}", kind, choice.name), choice.why_not.empty());
    tooltip(choice.why_not.empty() ? choice.text : choice.text + "\n" + choice.why_not);
}

/// Draws the choices that match the filter, one row per group.
void drawChoices(const char* title, const char* kind, const std::vector<ExportChoice>& choices,
                 const std::string& filter, std::vector<std::string>& turned) {
    std::vector<std::string> groups;
    for (const ExportChoice& choice : choices) {
        const bool known = std::ranges::find(groups, choice.group) != groups.end();
        if (!known && matchesFilter(choice, filter)) groups.push_back(choice.group);
    }
    formLabel("");
    ImGui::PushFont(fonts().bold);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    if (groups.empty()) {
        ImGui::SameLine();
        cutText("No name or description contains this text", palette().text_dim);
    }
    for (const std::string& group : groups) {
        formLabel(group.c_str());
        bool first = true;
        for (const ExportChoice& choice : choices) {
            if (choice.group != group || !matchesFilter(choice, filter)) continue;
            if (!first) flowTo(("[x] " + choice.name).c_str());
            first = false;
            drawChoice(choice, kind, turned);
        }
    }
}

float widestGroup(const std::vector<ExportChoice>& choices) {
    float width = 0.0F;
    for (const ExportChoice& choice : choices) {
        width = std::max(width, ImGui::CalcTextSize(choice.group.c_str()).x);
    }
    return width;
}

/// Begins a form whose names have a width in px, so that none is cut in a small window.
bool beginGroups(const char* id, float names) {
    if (!ImGui::BeginTable(id, 2)) return false;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, names + scaled(8));
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

}  // namespace

void drawContentsBar(const ExportView& view, ExportDraft& draft) {
    if (view.presets.empty()) return drawSearch(draft);
    const float room = ImGui::GetContentRegionAvail().x;
    drawPresetName(view, draft);
    const bool wide = room >= scaled(880);
    if (wide) {
        drawPresetButtons(view, draft, true);
        ImGui::SameLine();
    }
    drawSearch(draft);
    if (!wide) drawPresetButtons(view, draft, false);
    ImGui::Separator();
}

void drawModalities(const ExportView& view, ExportDraft& draft) {
    if (!beginGroups("modalities", widestGroup(view.modalities))) return;
    drawChoices("Modalities", "modality", view.modalities, draft.filter, draft.turned_modalities);
    endForm();
}

void drawFormats(const ExportView& view, ExportDraft& draft) {
    const float others = ImGui::CalcTextSize("Moving objects").x;
    if (!beginGroups("contents", std::max(widestGroup(view.formats), others))) return;
    drawChoices("Formats", "format", view.formats, draft.filter, draft.turned_formats);
    if (wantsFlow(view, draft)) {
        formLabel("Flow to frames", "Distances in frames, later and earlier, separated by commas");
        ImGui::SetNextItemWidth(-FLT_MIN);
        ImGui::InputText("##flow", &draft.flow_distances);
        nameItem("export.flow_distances");
    }
    if (view.has_tracks) {
        formLabel("Moving objects");
        ImGui::Checkbox("stay at their planned poses", &draft.still);
        nameItem("export.still");
    }
    formLabel("Other files");
    ImGui::Checkbox("may be in the folder", &draft.overwrite);
    nameItem("export.overwrite");
    tooltip("These files are kept. If this is off, the folder must be empty or contain a dataset.");
    endForm();
}

}  // namespace dollytrack::ui
