#include "ui/panels/export/export_jobs.h"

#include "ui/theme.h"
#include "ui/widgets/cut_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/icon_button.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

std::string nameFor(const ExportJob& job, const char* widget) {
    return fmt::format("export.job.{}.{}", job.id, widget);
}

void drawState(const ExportJob& job, bool held) {
    switch (job.state) {
        case ExportState::Waiting:
            ImGui::TextColored(palette().text_dim, "%s", held ? "on hold" : "waiting");
            break;
        case ExportState::Running:
            ImGui::TextColored(palette().accent, "%s",
                               job.stage.empty() ? "running" : job.stage.c_str());
            break;
        case ExportState::Stopping:
            ImGui::TextColored(palette().warning, "stopping …");
            break;
        case ExportState::Done:
            ImGui::TextColored(palette().good, "done");
            break;
        case ExportState::Cancelled:
            ImGui::TextColored(palette().warning, "cancelled");
            break;
        case ExportState::Failed:
            ImGui::TextColored(palette().bad, "failed");
            break;
    }
}

}  // namespace

std::string progressText(const ExportJob& job) {
    std::string text;
    if (job.frames > 0) text = fmt::format("{} of {} frames", job.frames_done, job.frames);
    if (job.state != ExportState::Running) return text;
    if (job.frames_per_s > 0.0) text += fmt::format(", {:.1f} a second", job.frames_per_s);
    if (job.seconds_left > 0.0) {
        text += (text.empty() ? "" : ", ") + durationText(job.seconds_left) + " left";
    }
    return text;
}

namespace {

void drawQueueButtons(const ExportView& view, const ExportJob& job, std::size_t index,
                      ExportActions& actions) {
    const float side = ImGui::GetTextLineHeight() + scaled(4);
    const float gap = scaled(3);
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 3 * side - 2 * gap);
    if (iconButton(Icon::Up, nameFor(job, "earlier"),
                   {"Earlier", index == 0 ? "It is already the first." : "", false, true})) {
        actions.earlier = job.id;
    }
    ImGui::SameLine(0, gap);
    const bool is_last = index + 1 == view.jobs.size();
    if (iconButton(Icon::Down, nameFor(job, "later"),
                   {"Later", is_last ? "It is already the last." : "", false, true})) {
        actions.later = job.id;
    }
    ImGui::SameLine(0, gap);
    const char* tip = job.active() ? "Cancel and remove from the queue; frames are kept"
                                   : "Remove from the queue; the dataset is kept";
    if (iconButton(Icon::Close, nameFor(job, "remove"), {tip, {}, false, true})) {
        actions.remove = job.id;
    }
}

void drawOutcomeButtons(const ExportView& view, const ExportJob& job, ExportActions& actions) {
    bool first = true;
    const auto offer = [&](const char* label, const char* widget, ButtonOptions options,
                           int& asked) {
        if (!first) flowTo(label);
        first = false;
        if (button(label, nameFor(job, widget), options)) asked = job.id;
    };
    // Cancel stays in its position (disabled) after use, so that a second click does not press
    // Continue.
    if (job.state != ExportState::Done) {
        const bool can = job.active() || job.state == ExportState::Waiting;
        offer("Cancel", "cancel",
              {job.state == ExportState::Stopping ? "It stops after the current frame."
               : can                              ? ""
                                                  : "It is not running.",
               "Stop after the current frame; Continue resumes it"},
              actions.cancel);
    }
    if (job.state == ExportState::Cancelled || job.state == ExportState::Failed) {
        offer(job.frames_done > 0 ? "Continue" : "Try again", "resume",
              {{}, job.frames_done > 0 ? "Resume after the finished frames" : ""}, actions.resume);
    }
    if (job.state == ExportState::Done) {
        offer("Contact sheet", "sheet",
              {job.contact_sheet.empty() ? "This dataset has no contact sheet." : "",
               "Show the contact sheet"},
              actions.show_sheet);
    }
    if (job.frames_done > 0 || job.state == ExportState::Done) {
        offer("Open folder", "open", {view.why_no_folder, job.request.folder.string()},
              actions.open_folder);
    }
}

void drawJob(const ExportView& view, std::size_t index, ExportActions& actions) {
    const ExportJob& job = view.jobs[index];
    ImGui::PushID(job.id);
    ImGui::Separator();
    const float buttons = 3 * (ImGui::GetTextLineHeight() + scaled(8));
    const float state = ImGui::CalcTextSize("cancelled  ").x;
    const float least = scaled(40);
    const float room = std::max(ImGui::GetContentRegionAvail().x - buttons - state, least);
    ImGui::TextUnformatted(cutToWidth(job.request.name, room, Cut::Middle).c_str());
    tooltip(job.request.name);
    ImGui::SameLine();
    drawState(job, view.held);
    drawQueueButtons(view, job, index, actions);
    cutText(job.request.folder.string(), palette().text_dim, {}, Cut::Middle);
    nameItem(nameFor(job, "folder"));
    if (job.active()) {
        const float width = ImGui::GetContentRegionAvail().x;
        const std::string progress = progressText(job);
        ImGui::ProgressBar(static_cast<float>(job.fraction),
                           {-1, ImGui::GetTextLineHeight() + scaled(4)},
                           cutToWidth(progress, width - scaled(12)).c_str());
        wholeText(progress, width - scaled(12));
    } else if (job.frames > 0) {
        paragraph(progressText(job));
    }
    if (job.state == ExportState::Failed) {
        paragraph(describe(job.error), palette().bad);
        if (!job.last_words.empty()) {
            std::string words;
            for (const std::string& line : job.last_words) words += line + "\n";
            ImGui::TextColored(palette().text_dim, "Program output");
            tooltip(words);
        }
    }
    drawOutcomeButtons(view, job, actions);
    ImGui::PopID();
}

}  // namespace

std::string durationText(double seconds) {
    const long s = std::lround(std::max(seconds, 0.0));
    if (s >= 3600) return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
    if (s >= 60) return fmt::format("{} min {} s", s / 60, s % 60);
    return fmt::format("{} s", s);
}

void drawExportJobs(const ExportView& view, ExportActions& actions) {
    heading("Queue");
    if (view.jobs.empty()) {
        ImGui::TextDisabled("The queue is empty.");
        return;
    }
    flowTo("Hold on");
    const auto waiting = std::ranges::count(view.jobs, ExportState::Waiting, &ExportJob::state);
    const char* label = view.held ? "Go on" : "Hold";
    const std::string none = "No export is waiting.";
    if (button(label, "export.hold",
               {!view.held && waiting == 0 ? none : "",
                view.held ? "Start waiting exports"
                          : "Finish the running export, but start no further one",
                0.0F, true})) {
        actions.toggle_hold = true;
    }
    for (std::size_t i = 0; i < view.jobs.size(); ++i) drawJob(view, i, actions);
}

}  // namespace dollytrack::ui
