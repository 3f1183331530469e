#include "ui/panels/export/export_panel.h"

#include "ui/panels/export/export_contents.h"
#include "ui/panels/export/export_draft.h"
#include "ui/panels/export/export_jobs.h"
#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/fields/field_editor.h"
#include "ui/widgets/fields/parameter_row.h"
#include "ui/widgets/form.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <optional>

namespace dollytrack::ui {
namespace {

/// Places the next widget of a row on the same line, or on a new one.
void besideOrBelow(bool beside) {
    if (beside) {
        ImGui::SameLine();
    } else {
        formLabel("");
    }
}

void drawFolder(const ExportView& view, ExportDraft& draft, ExportActions& actions) {
    formLabel("Folder", "Folder for the dataset; created if missing");
    const char* label = "Choose…";
    const float width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(-width - ImGui::GetStyle().ItemSpacing.x);
    ImGui::InputTextWithHint("##folder", "a folder for the dataset", &draft.folder);
    nameItem("export.folder");
    tooltip(draft.folder);
    ImGui::SameLine();
    if (button(label, "export.choose_folder")) actions.choose_folder = true;
    // Always one line, so that the widgets below keep their position.
    const std::string none =
        draft.folder.empty() ? "New, empty, or that of a dataset." : "It is empty.";
    const bool bad = !view.why_not_folder.empty();
    const std::string& says = bad ? view.why_not_folder : view.folder_says;
    const ImVec4& color = bad                                  ? palette().bad
                          : view.folder_warns && !says.empty() ? palette().warning
                                                               : palette().text_dim;
    cutText(says.empty() ? none : says, color);
}

struct SizeField {
    const Field* field = nullptr;
    const Field* standard = nullptr;
    const Field::Integer* number = nullptr;
};

/// The parameters `width_px` and `height_px`; nullopt if the project lacks one.
std::optional<std::array<SizeField, 2>> sizeFields(const ExportView& view) {
    if (view.parameters == nullptr) return std::nullopt;
    std::array<SizeField, 2> sizes;
    for (std::size_t i = 0; i < 2; ++i) {
        const char* name = i == 0 ? "width_px" : "height_px";
        const auto field = std::ranges::find(*view.parameters, name, &Field::name);
        const auto standard = std::ranges::find(*view.standard, name, &Field::name);
        if (field == view.parameters->end() || standard == view.standard->end()) return {};
        sizes[i] = {&*field, &*standard, std::get_if<Field::Integer>(&field->value)};
        if (sizes[i].number == nullptr) return std::nullopt;
    }
    return sizes;
}

/// The image size is a parameter of the plan's camera; changing it updates the plan.
void drawImageSize(const ExportView& view, ExportDraft& draft, ExportActions& actions) {
    const auto sizes = sizeFields(view);
    if (!sizes) return;
    const char* camera = "Image size of the camera; changing it updates the plan.";
    formLabel("Image, px", camera);
    const char* keep = "keep ratio";
    const ImGuiStyle& style = ImGui::GetStyle();
    const float box = ImGui::GetFrameHeight() + style.ItemInnerSpacing.x +
                      ImGui::CalcTextSize(keep).x + style.ItemSpacing.x;
    const float cross = ImGui::CalcTextSize(" \u00d7 ").x;
    const float room = ImGui::GetContentRegionAvail().x;
    const bool beside = room - box > scaled(140);
    const float half = ((beside ? room - box : room) - cross) / 2;
    bool active = false;
    for (std::size_t i = 0; i < 2; ++i) {
        if (i == 1) {
            ImGui::SameLine(0, 0);
            ImGui::TextUnformatted(" \u00d7 ");
            ImGui::SameLine(0, 0);
        }
        const SizeField& size = (*sizes)[i];
        ImGui::SetNextItemWidth(half);
        const FieldEdit edit =
            drawFieldValue(*size.field, *size.standard, "export." + size.field->name);
        active = active || ImGui::IsItemActive();
        // The field's own note takes precedence over the tooltip.
        if (!edit.says) tooltip(camera);
        actions.finished = actions.finished || edit.finished;
        if (!edit.changed) continue;
        actions.edited = size.field->name;
        if (!draft.keep_ratio || draft.ratio <= 0.0) continue;
        const Field::Integer& other = *(*sizes)[1 - i].number;
        const double fits = *size.number->value * (i == 0 ? 1.0 / draft.ratio : draft.ratio);
        *other.value = static_cast<int>(other.info.range().nearest(std::round(fits)));
    }
    // The ratio is not updated during an edit, so that rounding errors do not add up.
    if (!active) draft.ratio = double(*(*sizes)[0].number->value) / *(*sizes)[1].number->value;
    besideOrBelow(beside);
    ImGui::Checkbox(keep, &draft.keep_ratio);
    nameItem("export.keep_ratio");
    tooltip("Width and height change together");
    formLine("");
    cutText("Another size updates the plan.", palette().text_dim);
}

void drawFrames(const ExportView& view, ExportDraft& draft) {
    const int most = std::max(view.frame_count - 1, 0);
    formLabel("Frames", fmt::format("First and last exported frame, and the step between exported "
                                    "frames; there are frames 0 to {}",
                                    most));
    // On the same line if there is room, so that a short panel shows it.
    const char* only = "current only";
    const float box = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
                      ImGui::CalcTextSize(only).x + ImGui::GetStyle().ItemSpacing.x;
    const float room = ImGui::GetContentRegionAvail().x;
    const bool beside = room - box > scaled(180);
    const float fields = beside ? room - box : room;
    ImGui::BeginDisabled(draft.current_only);
    int first = draft.first;
    int last = draft.last < 0 ? most : draft.last;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float third = std::floor((fields - 2 * gap) / 3);
    const bool wrong = isReversed(draft);
    if (wrong) ImGui::PushStyleColor(ImGuiCol_Text, palette().bad);
    ImGui::SetNextItemWidth(third);
    if (ImGui::DragInt("##first", &first, 0.5F, 0, most, "from %d")) {
        draft.first = std::max(first, 0);
    }
    nameItem("export.first");
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(third);
    if (ImGui::DragInt("##last", &last, 0.5F, 0, most, "to %d")) {
        // The last frame is stored as "to the end", which still holds for a longer plan.
        draft.last = last == most ? -1 : std::max(last, 0);
    }
    nameItem("export.last");
    if (wrong) ImGui::PopStyleColor();
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(third);
    ImGui::DragInt("##step", &draft.step, 0.1F, 1, std::max(most, 1), "every %d",
                   ImGuiSliderFlags_AlwaysClamp);
    nameItem("export.step");
    tooltip("1: all of them; 5: every fifth");
    ImGui::EndDisabled();
    besideOrBelow(beside);
    ImGui::Checkbox(only, &draft.current_only);
    nameItem("export.current_only");
    tooltip(fmt::format("Only the current frame, number {}", view.current_frame));
    // Always one line, so that the widgets below keep their position.
    formLine("");
    const std::string note = rangeNote(view, draft);
    if (note.empty() && !view.doubt.empty()) {
        cutText(view.doubt, palette().warning);
        nameItem("export.doubt");
    } else if (note.empty()) {
        cutText(view.frame_count == 0 ? "There are no frames yet."
                                      : fmt::format("There are frames 0 to {}.", most),
                palette().text_dim);
    } else {
        cutText(note, wrong ? palette().bad : palette().warning);
        nameItem("export.range_note");
    }
}

/// Rendering and sensor parameters, shown if the selected contents use them.
void drawPictureParameters(const ExportView& view, const ExportDraft& draft,
                           ExportActions& actions) {
    if (view.parameters == nullptr) return;
    const auto row = [&](const char* label, const char* tip,
                         std::initializer_list<std::string_view> names) {
        formLabel(label, tip);
        const ParameterRowEdit edit =
            drawParameterRow(*view.parameters, *view.standard, names, "export");
        if (!edit.name.empty()) actions.edited = edit.name;
        actions.finished = actions.finished || edit.finished;
    };
    if (const Field* mode = fieldNamed(*view.parameters, "render_mode");
        mode != nullptr && wantsPictures(view, draft)) {
        row("Images", "How colour images are rendered; other files do not change",
            {"render_mode", mode->valueText() == "fast"     ? "antialias"
                            : mode->valueText() == "traced" ? "traced_samples"
                                                            : "reference_samples"});
    }
    if (wantsPictures(view, draft)) {
        row("Light", "Light of the colour images; see the parameters for more",
            {"light_preset", "exposure_ev"});
    }
    if (wantsSensors(view, draft)) {
        row("Sensors", "Simulated camera sensors; see the parameters for more",
            {"sensor_preset", "depth_noise"});
    }
}

void drawRig(ExportDraft& draft, ExportActions& actions) {
    formLabel("Rig", "Additional cameras mounted on the planned one; their images go to cameras/");
    const char* label = "Choose…##rig";
    const float width =
        ImGui::CalcTextSize(label, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(-width - ImGui::GetStyle().ItemSpacing.x);
    const char* hint = "none, or a JSON file of cameras";
    const float room = ImGui::GetContentRegionAvail().x - width - ImGui::GetStyle().ItemSpacing.x -
                       2 * ImGui::GetStyle().FramePadding.x;
    if (ImGui::CalcTextSize(hint).x > room) hint = "none";
    ImGui::InputTextWithHint("##rig_file", hint, &draft.rig);
    nameItem("export.rig");
    tooltip(draft.rig);
    ImGui::SameLine();
    if (button(label, "export.choose_rig")) actions.choose_rig = true;
}

void drawPlace(const ExportView& view, ExportDraft& draft, ExportActions& actions) {
    if (!beginForm("place", 0.22F)) return;
    drawFolder(view, draft, actions);
    drawImageSize(view, draft, actions);
    drawFrames(view, draft);
    drawPictureParameters(view, draft, actions);
    drawRig(draft, actions);
    endForm();
}

/// The Export button and the progress of the running job; always visible, also in a short panel.
void drawFooter(const ExportView& view, const ExportDraft& draft, ExportActions& actions) {
    ImGui::Separator();
    if (button("Export", "export.add",
               {.why_not = whyNot(view, draft),
                .tip = "Add it to the queue",
                .width = scaled(110),
                .primary = true})) {
        actions.add_current = true;
    }
    flowTo("Add projects…");
    if (button("Add projects…", "export.add_files",
               {isReversed(draft) ? rangeNote(view, draft) : "",
                fmt::format("Queue other .dolly files: {}, with the modalities, formats and rig "
                            "chosen here and their own parameters; each gets a folder beside {}",
                            rangeForOthers(draft) == "::" ? "all of their frames"
                                                          : "this range of their frames",
                            draft.folder.empty() ? "its project" : "this one")})) {
        actions.add_files = true;
    }
    if (!view.reading.empty()) {
        flowTo(("reading " + view.reading + " \u2026  Cancel").c_str());
        actions.cancel_reading = drawReading(view.reading, "export.cancel_reading");
    }
    const auto running = std::ranges::find_if(view.jobs, &ExportJob::active);
    if (running == view.jobs.end()) {
        const std::string summary = summaryOf(view, draft);
        flowTo(summary.c_str());
        ImGui::AlignTextToFramePadding();
        cutText(summary, palette().text_dim,
                "The image size is a parameter of the camera; the plan depends on it.");
        return;
    }
    const std::string progress = running->request.name + ": " + progressText(*running);
    flowTo((progress + "  " + progress).c_str());
    ImGui::ProgressBar(static_cast<float>(running->fraction), {-1, ImGui::GetFrameHeight()},
                       progress.c_str());
    nameItem("export.progress");
    tooltip(progress);
}

}  // namespace

ExportActions drawExportPanel(const ExportView& view, ExportDraft& draft) {
    ExportActions actions;
    const ImGuiStyle& style = ImGui::GetStyle();
    drawContentsBar(view, draft);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    // A panel below the viewport is wide and short, at a side narrow and tall.
    const bool queue = !view.jobs.empty();
    const bool wide = room.x >= scaled(queue ? 900 : 780);
    const float footer =
        (wide ? 1.0F : 2.0F) * ImGui::GetFrameHeightWithSpacing() + 2 * style.ItemSpacing.y;
    const float height = std::max(room.y - footer, ImGui::GetFrameHeight());
    if (wide) {
        actions.missing_height = -height;
        // An empty queue needs no column, and in a wide panel the formats have one of their own.
        const bool apart = room.x >= scaled(queue ? 1150 : 1000);
        const std::array<float, 4> shares = queue ? (apart ? std::array{0.26F, 0.28F, 0.23F, 0.23F}
                                                           : std::array{0.33F, 0.41F, 0.0F, 0.26F})
                                                  : (apart ? std::array{0.32F, 0.37F, 0.31F, 0.0F}
                                                           : std::array{0.42F, 0.58F, 0.0F, 0.0F});
        const float all = room.x - 3 * style.ItemSpacing.x;
        const auto column = [&](const char* id, float share, const auto& draw) {
            ImGui::BeginChild(id, {std::floor(share * all), height});
            draw();
            // The cursor is below the whole content, including what is scrolled out of view.
            actions.missing_height =
                std::max(actions.missing_height, ImGui::GetCursorPosY() - height);
            ImGui::EndChild();
        };
        column("place", shares[0], [&] { drawPlace(view, draft, actions); });
        ImGui::SameLine();
        column("contents", shares[1], [&] {
            drawModalities(view, draft);
            if (!apart) drawFormats(view, draft);
        });
        if (apart) {
            ImGui::SameLine();
            column("formats", shares[2], [&] { drawFormats(view, draft); });
        }
        if (queue) {
            ImGui::SameLine();
            column("queue", shares[3], [&] { drawExportJobs(view, actions); });
        }
    } else {
        ImGui::BeginChild("export", {0, height});
        drawPlace(view, draft, actions);
        drawModalities(view, draft);
        drawFormats(view, draft);
        drawExportJobs(view, actions);
        ImGui::EndChild();
    }
    drawFooter(view, draft, actions);
    return actions;
}

}  // namespace dollytrack::ui
