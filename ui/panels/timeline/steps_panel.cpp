#include "ui/panels/timeline/steps_panel.h"

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

using StepKind = AlgorithmStep::Kind;

struct GroupStyle {
    const char* name;
    const char* text;
};
constexpr std::array<GroupStyle, kStepGroups> kGroups = {{
    {"Sample", "A key frame drawn at random"},
    {"Near", "Its nearest vertex, by cost"},
    {"Edge", "A straight move to test"},
    {"CollisionFree", "Whether that move is collision-free"},
    {"Link", "RRT* joins separate parts"},
    {"Prune", "Edges that close a cycle are removed"},
    {"Branch", "The order of visits along the path"},
}};
constexpr std::array kSpeeds = {2.0, 10.0, 50.0, 250.0};

void updateRows(const StepsView& view, StepsState& state) {
    if (state.rows_of == view.serial && state.rows_by == state.shown) return;
    state.rows_of = view.serial;
    state.rows_by = state.shown;
    state.rows.clear();
    const auto& steps = view.steps->steps;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (state.shown[static_cast<std::size_t>(groupOf(steps[i].kind))]) {
            state.rows.push_back(static_cast<std::uint32_t>(i));
        }
    }
}

/// Number of steps taken after the next refused move; nullopt if none follows.
std::optional<std::size_t> nextRefusal(const StepsView& view) {
    const auto& steps = view.steps->steps;
    const auto at =
        std::find_if(steps.begin() + static_cast<std::ptrdiff_t>(view.taken), steps.end(),
                     [](const AlgorithmStep& step) { return step.kind == StepKind::Refused; });
    if (at == steps.end()) return std::nullopt;
    return static_cast<std::size_t>(at - steps.begin()) + 1;
}

void drawTransport(const StepsView& view, const StepsState& state, StepsActions& actions) {
    const std::size_t all = view.steps->steps.size();
    const std::string at_start = view.taken == 0 ? "This is before the first step." : "";
    const std::string at_end = view.taken == all ? "This is after the last step." : "";
    const auto back = nextStop(state.rows, view.taken, -1);
    const auto forward = nextStop(state.rows, view.taken, 1);
    const auto go = [&](Icon icon, const char* name, const char* tip, const std::string& why_not,
                        std::size_t taken) {
        if (iconButton(icon, name, {tip, why_not})) actions.go_to = taken;
        ImGui::SameLine(0, scaled(3));
    };
    const std::string none_left = !at_end.empty() ? at_end
                                  : forward       ? ""
                                                  : "No further step of the kinds shown.";
    go(Icon::ToStart, "steps.first", "Before the first step", at_start, 0);
    go(Icon::StepBack, "steps.back", "One step back", at_start, back.value_or(0));
    if (iconButton(view.playing ? Icon::Pause : Icon::Play, "steps.play",
                   {view.playing ? "Pause" : "Play", view.playing ? "" : none_left})) {
        actions.toggle_play = true;
    }
    ImGui::SameLine(0, scaled(3));
    go(Icon::StepForward, "steps.forward", "One step forward", none_left, forward.value_or(all));
    go(Icon::ToEnd, "steps.last", "After the last step", at_end, all);
    ImGui::NewLine();
    ImGui::SameLine(0, 0);
}

void drawSpeedAndRefusal(const StepsView& view, StepsState& state, StepsActions& actions) {
    ImGui::SetNextItemWidth(scaled(112));
    const bool open =
        ImGui::BeginCombo("##speed", fmt::format("{:g} steps/s", state.per_second).c_str());
    nameItem("steps.speed");
    if (open) {
        for (const double speed : kSpeeds) {
            const std::string text = fmt::format("{:g} steps/s", speed);
            if (ImGui::Selectable(text.c_str(), speed == state.per_second)) {
                state.per_second = speed;
            }
            nameItem(fmt::format("steps.speed.{:g}", speed));
        }
        ImGui::EndCombo();
    }
    flowTo("Next collision");
    const auto refusal = nextRefusal(view);
    if (button("Next collision", "steps.next_refusal",
               {refusal ? "" : "No later move collides.", "To the next move that would collide"})) {
        actions.go_to = refusal;
    }
}

ImVec4 colorOf(StepKind kind) {
    if (kind == StepKind::Refused || kind == StepKind::LinkFailed) return palette().bad;
    if (kind == StepKind::Accepted || kind == StepKind::LinkFound) return palette().good;
    if (kind == StepKind::Prune) return palette().warning;
    return ImGui::GetStyleColorVec4(ImGuiCol_Text);
}

/// The full text of the latest step, which the list may cut. At least two lines high, so that the
/// widgets below rarely move.
void drawCurrent(const StepsView& view) {
    const float top = ImGui::GetCursorPosY();
    if (view.taken == 0) {
        paragraph("Before the first step.", palette().text_dim);
    } else if (view.describe) {
        paragraph(view.describe(view.taken - 1), colorOf(view.steps->steps[view.taken - 1].kind));
    }
    const float end = top + 2 * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
    ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), end));
}

void drawFilter(StepsState& state) {
    for (std::size_t i = 0; i < kStepGroups; ++i) {
        if (i > 0) flowTo(fmt::format("[x] {}", kGroups[i].name).c_str());
        ImGui::Checkbox(kGroups[i].name, &state.shown[i]);
        nameItem(std::string("steps.show.") + kGroups[i].name);
        tooltip(kGroups[i].text);
    }
}

void drawList(const StepsView& view, StepsState& state, StepsActions& actions) {
    ImGui::BeginChild("steps");
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const auto current = static_cast<std::uint32_t>(view.taken);
    // The first row that is not taken yet; the row before it is the latest listed step.
    const auto at = std::ranges::lower_bound(state.rows, current);
    const auto place = static_cast<float>(at - state.rows.begin());
    if (state.scrolled_to != view.taken) {
        state.scrolled_to = view.taken;
        ImGui::SetScrollY(std::max(0.0F, (place - 0.5F) * row - ImGui::GetWindowHeight() / 2));
    }
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(state.rows.size()), row);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const std::size_t index = state.rows[i];
            const bool taken = index < view.taken;
            const std::string text = view.describe ? view.describe(index) : std::string();
            ImGui::PushID(i);
            // Future steps are dim; a transparent colour would be too pale on white.
            ImGui::PushStyleColor(
                ImGuiCol_Text, taken ? colorOf(view.steps->steps[index].kind) : palette().text_dim);
            const std::string line = fmt::format("{}   {}", index + 1, text);
            const float room = ImGui::GetContentRegionAvail().x;
            if (ImGui::Selectable(cutToWidth(line, room).c_str(), index + 1 == view.taken)) {
                actions.go_to = index + 1;
            }
            ImGui::PopStyleColor();
            nameItem(fmt::format("steps.row.{}", index));
            wholeText(line, room);
            ImGui::PopID();
        }
    }
    ImGui::EndChild();
}

}  // namespace

StepGroup groupOf(StepKind kind) {
    switch (kind) {
        case StepKind::Sample:
            return StepGroup::Sample;
        case StepKind::Near:
        case StepKind::Skip:
            return StepGroup::Near;
        case StepKind::Edge:
        case StepKind::Leave:
            return StepGroup::Edge;
        case StepKind::Accepted:
        case StepKind::Refused:
            return StepGroup::CollisionFree;
        case StepKind::Link:
        case StepKind::LinkSample:
        case StepKind::LinkFound:
        case StepKind::LinkFailed:
            return StepGroup::Link;
        case StepKind::Prune:
            return StepGroup::Prune;
        case StepKind::Visit:
            break;
    }
    return StepGroup::Branch;
}

std::optional<std::size_t> nextStop(const std::vector<std::uint32_t>& rows, std::size_t taken,
                                    int direction) {
    if (direction > 0) {
        const auto at = std::ranges::lower_bound(rows, taken);
        return at == rows.end() ? std::nullopt : std::optional<std::size_t>(*at + 1);
    }
    if (taken == 0) return std::nullopt;
    const auto at = std::ranges::lower_bound(rows, taken - 1);
    return at == rows.begin() ? 0 : *(at - 1) + std::size_t{1};
}

StepsActions drawStepsPanel(const StepsView& view, StepsState& state) {
    StepsActions actions;
    if (view.steps == nullptr) {
        ImGui::TextDisabled("There is no plan.");
        return actions;
    }
    updateRows(view, state);
    // A panel below the viewport is wide and short: the list goes beside the controls.
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const bool wide = room.x >= scaled(900);
    if (wide) ImGui::BeginChild("controls", {std::floor(0.44F * room.x), 0.0F});
    drawTransport(view, state, actions);
    drawSpeedAndRefusal(view, state, actions);
    const auto all = static_cast<int>(view.steps->steps.size());
    auto taken = static_cast<int>(view.taken);
    ImGui::SetNextItemWidth(-1);
    const std::string format = fmt::format("step %d of {}", all);
    if (ImGui::SliderInt("##taken", &taken, 0, all, format.c_str(), ImGuiSliderFlags_AlwaysClamp)) {
        actions.go_to = static_cast<std::size_t>(taken);
    }
    nameItem("steps.slider");
    drawCurrent(view);
    drawFilter(state);
    if (view.steps->left_out > 0) {
        paragraph(fmt::format("{} later steps were not recorded.", view.steps->left_out),
                  palette().warning);
    }
    if (wide) {
        ImGui::EndChild();
        ImGui::SameLine();
    } else {
        ImGui::Separator();
    }
    drawList(view, state, actions);
    return actions;
}

}  // namespace dollytrack::ui
