#include "ui/panels/export_panel.h"

#include "ui/panels/export_jobs.h"
#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

namespace dollytrack::ui {
namespace {

/// The frames the settings name, cut to what there is: first, one past the last, step.
struct Frames {
    int begin = 0;
    int end = 0;
    int step = 1;
};

Frames framesOf(const ExportView& view, const ExportDraft& draft) {
    if (draft.current_only) return {view.current_frame, view.current_frame + 1, 1};
    const int last = draft.last < 0 ? view.frame_count - 1 : draft.last;
    Frames frames;
    frames.begin = std::clamp(draft.first, 0, std::max(view.frame_count - 1, 0));
    frames.end =
        std::clamp(last + 1, frames.begin + 1, std::max(view.frame_count, frames.begin + 1));
    frames.step = std::max(draft.step, 1);
    return frames;
}

bool isIn(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

std::vector<std::string> chosen(const std::vector<ExportChoice>& all,
                                const std::vector<std::string>& left_out) {
    std::vector<std::string> names;
    for (const ExportChoice& choice : all) {
        if (!isIn(left_out, choice.name)) names.push_back(choice.name);
    }
    return names;
}

void drawFolder(ExportDraft& draft, ExportActions& actions) {
    formLabel("Folder", "Where the dataset is written; it is made if it is not there");
    const char* label = "Choose…";
    const float width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(-width - ImGui::GetStyle().ItemSpacing.x);
    ImGui::InputTextWithHint("##folder", "a folder for the dataset", &draft.folder);
    nameItem("export.folder");
    tooltip(draft.folder);
    ImGui::SameLine();
    if (button(label, "export.choose_folder")) actions.choose_folder = true;
}

void drawFrames(const ExportView& view, ExportDraft& draft) {
    formLabel("Frames");
    ImGui::Checkbox("Current frame only", &draft.current_only);
    nameItem("export.current_only");
    if (draft.current_only) return;
    const int most = std::max(view.frame_count - 1, 0);
    const Frames frames = framesOf(view, draft);
    int first = frames.begin;
    int last = frames.end - 1;
    formLabel("From – to", "Both are exported");
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    ImGui::SetNextItemWidth(half);
    if (ImGui::DragInt("##first", &first, 0.5F, 0, most, "%d", ImGuiSliderFlags_AlwaysClamp)) {
        draft.first = first;
        if (draft.last >= 0) draft.last = std::max(draft.last, first);
    }
    nameItem("export.first");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::DragInt("##last", &last, 0.5F, 0, most, "%d", ImGuiSliderFlags_AlwaysClamp)) {
        // To the end stays to the end when a new plan has more frames.
        draft.last = last == most ? -1 : last;
        draft.first = std::min(draft.first, last);
    }
    nameItem("export.last");
    formLabel("Every", "1: all of them; 5: every fifth");
    ImGui::DragInt("##step", &draft.step, 0.1F, 1, std::max(most, 1),
                   draft.step == 1 ? "frame" : "%d frames", ImGuiSliderFlags_AlwaysClamp);
    nameItem("export.step");
}

void drawChoices(const char* label, const char* kind, const std::vector<ExportChoice>& choices,
                 std::vector<std::string>& left_out) {
    formLabel(label);
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const ExportChoice& choice = choices[i];
        if (i > 0) flowTo(("[x] " + choice.name).c_str());
        bool wanted = !isIn(left_out, choice.name);
        if (ImGui::Checkbox(choice.name.c_str(), &wanted)) {
            if (wanted) {
                std::erase(left_out, choice.name);
            } else {
                left_out.push_back(choice.name);
            }
        }
        nameItem(fmt::format("export.{}.{}", kind, choice.name));
        tooltip(choice.text);
    }
}

std::string bytesText(double bytes) {
    if (bytes >= 1e9) return fmt::format("{:.1f} GB", bytes / 1e9);
    return fmt::format("{:.0f} MB", std::max(bytes / 1e6, 1.0));
}

void drawSummary(const ExportView& view, const ExportDraft& draft) {
    const int count = frameCountOf(view, draft);
    if (count == 0) return;
    std::string text = fmt::format("{} frame{}", count, count == 1 ? "" : "s");
    if (view.bytes_per_frame > 0.0) {
        text += ", at most about " + bytesText(count * view.bytes_per_frame);
    }
    formText("Makes", text);
}

/// Why the settings cannot be exported; empty when they can.
std::string whyNot(const ExportView& view, const ExportDraft& draft) {
    if (!view.why_not.empty()) return view.why_not;
    if (view.frame_count == 0) return "The trajectory has no frames.";
    if (draft.folder.empty()) return "Choose a folder first.";
    // To the program, no name means all.
    if (!view.modalities.empty() && chosen(view.modalities, draft.left_out_modalities).empty()) {
        return "Choose at least one modality.";
    }
    if (!view.formats.empty() && chosen(view.formats, draft.left_out_formats).empty()) {
        return "Choose at least one format.";
    }
    return {};
}

void drawSettings(const ExportView& view, ExportDraft& draft, ExportActions& actions) {
    heading("New dataset");
    if (!beginForm("settings")) return;
    formText("Project", view.project.empty() ? "none is open" : view.project);
    drawFolder(draft, actions);
    formText("Image",
             fmt::format("{} × {} px, {:g}°", view.camera.width_px, view.camera.height_px,
                         view.camera.hfov_deg),
             "Set with the camera's parameters, which the plan depends on");
    drawFrames(view, draft);
    drawChoices("Modalities", "modality", view.modalities, draft.left_out_modalities);
    drawChoices("Formats", "format", view.formats, draft.left_out_formats);
    formLabel("Other files");
    ImGui::Checkbox("may be in the folder", &draft.overwrite);
    nameItem("export.overwrite");
    tooltip("They stay. Without this, only an empty folder or an earlier dataset is written into.");
    drawSummary(view, draft);
    endForm();
    const std::string why_not = whyNot(view, draft);
    if (button("Export", "export.add",
               {why_not, "Put it in the queue; it starts when its turn comes", 0.0F, true})) {
        actions.add_current = true;
    }
    flowTo("Add projects…");
    if (button("Add projects…", "export.add_files",
               {draft.folder.empty() ? "Choose a folder first." : "",
                "Queue other .dolly files with these settings; each gets a folder beside this "
                "one"})) {
        actions.add_files = true;
    }
}

}  // namespace

int frameCountOf(const ExportView& view, const ExportDraft& draft) {
    if (view.frame_count == 0) return 0;
    const Frames frames = framesOf(view, draft);
    return (frames.end - frames.begin + frames.step - 1) / frames.step;
}

ExportRequest requestOf(const ExportView& view, const ExportDraft& draft) {
    const Frames frames = framesOf(view, draft);
    ExportRequest request;
    request.name = view.project;
    request.folder = draft.folder;
    // All is what the program does unasked, also those of a later version; and what is begun here
    // can be continued there without naming the frames.
    if (frames.begin != 0 || frames.end != view.frame_count || frames.step != 1) {
        request.range = fmt::format("{}:{}:{}", frames.begin, frames.end, frames.step);
    }
    if (!draft.left_out_modalities.empty()) {
        request.modalities = chosen(view.modalities, draft.left_out_modalities);
    }
    if (!draft.left_out_formats.empty()) {
        request.formats = chosen(view.formats, draft.left_out_formats);
    }
    request.overwrite = draft.overwrite;
    return request;
}

ExportActions drawExportPanel(const ExportView& view, ExportDraft& draft) {
    ExportActions actions;
    ImGui::BeginChild("export");
    drawSettings(view, draft, actions);
    drawExportJobs(view, actions);
    ImGui::EndChild();
    return actions;
}

}  // namespace dollytrack::ui
