#include "ui/panels/timeline/timeline_panel.h"

#include "ui/panels/timeline/timeline_strips.h"
#include "ui/panels/timeline/timeline_time.h"
#include "ui/panels/timeline/timeline_tracks.h"
#include "ui/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/icon_button.h"
#include "ui/widgets/item_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace dollytrack::ui {
namespace {

constexpr std::array kSpeeds = {0.25, 0.5, 1.0, 2.0, 4.0};
constexpr const char* kNoFrames = "There is no trajectory yet.";

void drawButtons(const TimelineView& view, TimelineState& state, TimelineActions& actions) {
    const int last = view.frame_count - 1;
    const std::string none = view.frame_count == 0 ? kNoFrames : "";
    const std::string at_start =
        none.empty() && view.frame == 0 ? "This is the first frame." : none;
    const std::string at_end =
        none.empty() && view.frame >= last ? "This is the last frame." : none;
    const std::vector<TimelineKey> no_keys;
    const std::vector<TimelineKey>& keys = view.keys != nullptr ? *view.keys : no_keys;
    const std::optional<int> before = neighbourKey(keys, view.frame, -1);
    const std::optional<int> after = neighbourKey(keys, view.frame, 1);
    const auto key_why = [&](const std::optional<int>& key) {
        return !none.empty() ? none : key ? "" : "There is no later key frame.";
    };
    const auto go = [&](Icon icon, const char* name, const char* tip, const std::string& why_not,
                        int frame) {
        if (iconButton(icon, name, {tip, why_not})) actions.go_to = frame;
        ImGui::SameLine(0, scaled(3));
    };
    go(Icon::ToStart, "timeline.start", "First frame (Home)", at_start, 0);
    go(Icon::PreviousMark, "timeline.previous_key", "Previous key frame", key_why(before),
       before.value_or(0));
    go(Icon::StepBack, "timeline.back", "One frame back (Left)", at_start, view.frame - 1);
    if (iconButton(view.playing ? Icon::Pause : Icon::Play, "timeline.play",
                   {view.playing ? "Pause (Space)" : "Play (Space)", none})) {
        actions.toggle_play = true;
    }
    ImGui::SameLine(0, scaled(3));
    go(Icon::StepForward, "timeline.forward", "One frame forward (Right)", at_end, view.frame + 1);
    go(Icon::NextMark, "timeline.next_key", "Next key frame", key_why(after), after.value_or(0));
    go(Icon::ToEnd, "timeline.end", "Last frame (End)", at_end, last);
    if (iconButton(Icon::Loop, "timeline.loop", {"Repeat from the start", {}, state.loop})) {
        state.loop = !state.loop;
    }
    ImGui::SameLine();
}

void drawSpeed(TimelineState& state) {
    ImGui::SetNextItemWidth(scaled(68));
    const bool open = ImGui::BeginCombo("##speed", fmt::format("×{:g}", state.speed).c_str());
    nameItem("timeline.speed");
    if (!open) tooltip("Playback speed");
    if (!open) return;
    for (const double speed : kSpeeds) {
        const std::string text = fmt::format("×{:g}", speed);
        if (ImGui::Selectable(text.c_str(), speed == state.speed)) state.speed = speed;
        nameItem(fmt::format("timeline.speed.{:g}", speed));
    }
    ImGui::EndCombo();
}

void drawPlace(const TimelineView& view, TimelineActions& actions) {
    const bool any = view.frame_count > 0;
    const int last = std::max(view.frame_count - 1, 0);
    ImGui::BeginDisabled(!any);
    int frame = view.frame;
    const std::string of = fmt::format("frame %d of {}", last);
    const std::string widest = fmt::format("frame {} of {}", last, last);
    ImGui::SetNextItemWidth(
        std::max(scaled(110), ImGui::CalcTextSize(widest.c_str()).x + scaled(16)));
    if (ImGui::DragInt("##frame", &frame, 0.3F, 0, last, any ? of.c_str() : "no frames",
                       ImGuiSliderFlags_AlwaysClamp)) {
        actions.go_to = frame;
    }
    nameItem("timeline.frame", any);
    tooltip(any ? "Drag, or Ctrl+click to type a frame" : kNoFrames);
    ImGui::SameLine();
    auto time = static_cast<float>(timeOf(view, view.frame));
    const double step_s = timeOf(view, view.frame + 1) - timeOf(view, view.frame);
    ImGui::SetNextItemWidth(scaled(78));
    if (ImGui::DragFloat("##time", &time, static_cast<float>(0.3 * step_s), 0.0F,
                         static_cast<float>(timeOf(view, last)), "%.2f s",
                         ImGuiSliderFlags_AlwaysClamp) &&
        view.frame_interval_s > 0.0) {
        actions.go_to = std::clamp(static_cast<int>(std::lround(frameAt(view, time))), 0, last);
    }
    nameItem("timeline.time", any);
    tooltip(any ? "Drag, or Ctrl+click to type a time" : kNoFrames);
    ImGui::EndDisabled();
}

/// Right end of the button row: captured counter, zoom reset, and the choice of strips.
void drawRightEnd(const TimelineView& view, TimelineState& state) {
    std::string counter;
    if (hasSeries(view)) {
        counter = fmt::format("{} of {} captured so far", view.series->captured_so_far[view.frame],
                              view.target_count);
    }
    const ImGuiStyle& style = ImGui::GetStyle();
    const auto widthOf = [&](const char* text) { return ImGui::CalcTextSize(text).x; };
    const float buttons = widthOf("Show all") + widthOf("Strips") + 4 * style.FramePadding.x +
                          2 * style.ItemSpacing.x;
    const float all = buttons + widthOf(counter.c_str());
    ImGui::SameLine();
    const float room = ImGui::GetContentRegionAvail().x;
    if (room < buttons) ImGui::NewLine();
    if (room > buttons) {
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                             std::max(0.0F, room - (room > all ? all : buttons)));
    }
    if (room > all) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(palette().text_dim, "%s", counter.c_str());
        ImGui::SameLine();
    }
    const bool zoomed = state.shown > 0.0;
    if (button("Show all", "timeline.fit",
               {zoomed ? "" : "All frames are shown; the mouse wheel zooms.", "Show all frames"})) {
        state.shown = 0.0;
    }
    ImGui::SameLine();
    if (button("Strips", "timeline.strips", {{}, "Curves below the scrubber"})) {
        ImGui::OpenPopup("strips");
    }
    if (!ImGui::BeginPopup("strips")) return;
    for (std::size_t i = 0; i < kTimelineStrips; ++i) {
        const auto strip = static_cast<TimelineStrip>(i);
        const StripStyle& text = stripStyle(strip);
        const bool measured = isMeasured(view, strip);
        ImGui::BeginDisabled(!measured);
        ImGui::Checkbox(text.title, &state.strips[i]);
        ImGui::EndDisabled();
        nameItem(std::string("timeline.strip.") + text.name, measured);
        if (!measured) tooltip("Switch on the layer Weak frames to measure it.");
    }
    ImGui::EndPopup();
}

}  // namespace

std::optional<int> neighbourKey(const std::vector<TimelineKey>& keys, int frame, int direction) {
    if (direction > 0) {
        const auto at = std::ranges::upper_bound(keys, frame, {}, &TimelineKey::frame);
        return at == keys.end() ? std::nullopt : std::optional(at->frame);
    }
    const auto at = std::ranges::lower_bound(keys, frame, {}, &TimelineKey::frame);
    return at == keys.begin() ? std::nullopt : std::optional((at - 1)->frame);
}

TimelineActions drawTimelinePanel(const TimelineView& view, TimelineState& state) {
    TimelineActions actions;
    if (state.count != view.frame_count) {
        state.count = view.frame_count;
        state.shown = 0.0;
        state.first = 0.0;
    }
    drawButtons(view, state, actions);
    drawSpeed(state);
    ImGui::SameLine();
    drawPlace(view, actions);
    drawRightEnd(view, state);
    TimelineActions in_tracks = drawTimelineTracks(view, state);
    if (!in_tracks.go_to) in_tracks.go_to = actions.go_to;
    in_tracks.toggle_play = actions.toggle_play;
    state.last_frame = view.frame;
    return in_tracks;
}

}  // namespace dollytrack::ui
