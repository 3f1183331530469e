#include "ui/panels/timeline/track_bar.h"

#include "ui/theme.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/form.h"
#include "ui/widgets/icon_button.h"
#include "ui/widgets/item_map.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

constexpr DragRange kTimeRange = {0.0, 1e6, 0.02F, "%.2f", " s"};

/// Draws the selected object's keys on the slider.
void drawKeys(const TrackBarView& view, double end_s, ImVec2 low, ImVec2 high) {
    const float inset = 0.5F * ImGui::GetStyle().GrabMinSize + 2.0F;  // ImGui's slider margin
    const float half = scaled(4);
    const float y = 0.5F * (low.y + high.y);
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (const double key : view.keys_s) {
        const auto share = static_cast<float>(std::min(key / end_s, 1.0));
        const float x = low.x + inset + share * (high.x - low.x - 2.0F * inset);
        list->AddQuadFilled({x, y - half}, {x + half, y}, {x, y + half}, {x - half, y},
                            ImGui::GetColorU32(palette().accent));
        list->AddQuad({x, y - half}, {x + half, y}, {x, y + half}, {x - half, y},
                      IM_COL32(0, 0, 0, 140));
    }
}

}  // namespace

double trackBarEnd(double last_s) {
    return std::max(5.0, std::ceil(1.25 * last_s));
}

TrackBarActions drawTrackBar(const TrackBarView& view) {
    TrackBarActions actions;
    const std::string why_not =
        view.last_s > 0.0 ? "" : "The only key is at 0 s; add one at a later time.";
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Moving objects");
    tooltip(
        "Time of the objects' tracks: objects with keys are at their poses of this time, and the "
        "plan is made for them. The row below is the time along the camera's trajectory.");
    ImGui::SameLine();
    if (iconButton(view.playing ? Icon::Pause : Icon::Play, "tracks.play",
                   {view.playing ? "Pause" : "Play the tracks; each step is planned", why_not})) {
        actions.toggle_play = true;
    }
    ImGui::SameLine();
    // A time beyond the usual end extends the slider.
    const double end_s = std::max(trackBarEnd(view.last_s), view.time_s);
    const float number = scaled(96);
    const char* const elsewhere = "moved manually since";
    const float note =
        view.is_there ? 0.0F : ImGui::CalcTextSize(elsewhere).x + ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(
        std::max(ImGui::GetContentRegionAvail().x - number - note - ImGui::GetStyle().ItemSpacing.x,
                 scaled(80)));
    auto time = static_cast<float>(view.time_s);
    if (ImGui::SliderFloat("##track time", &time, 0.0F, static_cast<float>(end_s), "",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput)) {
        // Rounded to hundredths, as displayed beside it.
        actions.go_to_s = std::round(100.0 * static_cast<double>(time)) / 100.0;
    }
    actions.finished = ImGui::IsItemDeactivated();
    nameItem("tracks.slider");
    drawKeys(view, end_s, ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(number);
    double exact = view.time_s;
    const FieldEdit typed = dragNumber(exact, kTimeRange, "tracks.time", "Time of the tracks");
    if (typed.changed) actions.go_to_s = exact;
    actions.finished = actions.finished || typed.finished;
    if (!view.is_there) {
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(palette().text_dim, "%s", elsewhere);
        nameItem("tracks.elsewhere");
        tooltip(
            "An object is not at its track's pose of this time. Add a key with its pose, or choose "
            "a time to move it back.");
    }
    return actions;
}

}  // namespace dollytrack::ui
