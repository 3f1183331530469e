#include "ui/panels/timeline/timeline_strips.h"

#include "engine/plan/frame_quality.h"
#include "ui/theme.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::ui {
namespace {

constexpr std::array<StripStyle, kTimelineStrips> kStyles = {{
    {"clearance", "Clearance", " m", 2, 0.58F},
    {"speed", "Speed", " m/s", 2, 0.40F},
    {"turn", "Turn rate", "°/s", 0, 0.78F},
    {"score", "Score", "", 2, 0.12F},
    {"in_view", "Targets in view", "", 0, 0.50F},
    {"captured", "Captured so far", "", 0, 0.33F},
    {"image_corners", "Image corners", "", 0, 0.04F},
    {"overlap", "Overlap", "", 2, 0.90F},
}};

/// Calls `use` with the strip's values as a typed vector (double or int), empty if there are none.
template <class Use>
auto withValues(const TimelineView& view, TimelineStrip strip, const Use& use) {
    static const FrameSeries kNoSeries;
    const FrameSeries& series = view.series != nullptr ? *view.series : kNoSeries;
    const FrameQuality* quality = view.quality;
    switch (strip) {
        case TimelineStrip::Clearance:
            return use(series.clearance_m);
        case TimelineStrip::Speed:
            return use(series.speed_mps);
        case TimelineStrip::Turn:
            return use(series.turn_dps);
        case TimelineStrip::Score:
            return use(series.score);
        case TimelineStrip::InView:
            return use(series.in_view);
        case TimelineStrip::Captured:
            return use(series.captured_so_far);
        case TimelineStrip::ImageCorners:
            return use(quality != nullptr ? quality->image_corners : series.image_corners);
        case TimelineStrip::Overlap:
            break;
    }
    return use(quality != nullptr ? quality->overlap : kNoSeries.score);
}

int countOf(const TimelineView& view, TimelineStrip strip) {
    return withValues(view, strip,
                      [](const auto& values) { return static_cast<int>(values.size()); });
}

/// The strip of the plan that was measured before, with its frame count, which is 0 if it has no
/// values.
TimelineView earlierView(const TimelineView& view, TimelineStrip strip) {
    TimelineView before = view;
    before.series = view.earlier;
    before.quality = view.earlier_quality;
    before.frame_count = countOf(before, strip);
    return before;
}

struct Extremes {
    double low = 0.0;
    double high = 0.0;
};

Extremes extremesOf(const TimelineView& view, TimelineStrip strip, int begin, int end) {
    return withValues(view, strip, [&](const auto& values) {
        const auto range = std::minmax_element(values.begin() + begin, values.begin() + end);
        return Extremes{static_cast<double>(*range.first), static_cast<double>(*range.second)};
    });
}

double limitOf(const TimelineView& view, TimelineStrip strip) {
    if (strip == TimelineStrip::Clearance) return view.camera_radius_m;
    if (strip == TimelineStrip::Speed) return view.max_speed_mps;
    if (strip == TimelineStrip::Turn) return view.max_turn_dps;
    if (strip == TimelineStrip::ImageCorners) return kTrackableCorners;
    if (strip == TimelineStrip::Overlap) return kLeastOverlap;
    return 0.0;
}

/// Upper end of the value axis, over all frames, so that zooming does not change heights.
double topOf(const TimelineView& view, TimelineStrip strip) {
    double top = limitOf(view, strip);
    if (strip == TimelineStrip::Captured) top = view.target_count;
    top = std::max(top, extremesOf(view, strip, 0, view.frame_count).high);
    return top > 0.0 ? top : 1.0;
}

std::string number(TimelineStrip strip, double value) {
    return fmt::format("{:.{}f}", value, stripStyle(strip).digits);
}

ImU32 colorOf(TimelineStrip strip, float alpha) {
    const ImVec4 text = ImGui::GetStyleColorVec4(ImGuiCol_Text);
    const bool dark = text.x > 0.5F;
    ImVec4 color(0, 0, 0, alpha);
    ImGui::ColorConvertHSVtoRGB(stripStyle(strip).hue, dark ? 0.55F : 0.80F, dark ? 0.92F : 0.62F,
                                color.x, color.y, color.z);
    return ImGui::GetColorU32(color);
}

}  // namespace

const StripStyle& stripStyle(TimelineStrip strip) {
    return kStyles[static_cast<std::size_t>(strip)];
}

bool hasSeries(const TimelineView& view) {
    return view.series != nullptr && view.frame_count > 0 &&
           view.series->size() == static_cast<std::size_t>(view.frame_count);
}

bool hasValues(const TimelineView& view, TimelineStrip strip) {
    return view.frame_count > 0 && countOf(view, strip) == view.frame_count;
}

bool isMeasured(const TimelineView& view, TimelineStrip strip) {
    const bool optional = strip == TimelineStrip::ImageCorners || strip == TimelineStrip::Overlap;
    if (!optional || view.measures_quality || hasValues(view, strip)) return true;
    return !hasSeries(view) && earlierView(view, strip).frame_count > 0;
}

bool isShown(const TimelineView& view, const TimelineState& state, TimelineStrip strip) {
    return state.strips[static_cast<std::size_t>(strip)] && isMeasured(view, strip);
}

std::string stripText(const TimelineView& view, TimelineStrip strip, int frame) {
    const double value = withValues(
        view, strip, [&](const auto& values) { return static_cast<double>(values[frame]); });
    return number(strip, value) + stripStyle(strip).unit;
}

std::string stripRange(const TimelineView& view, TimelineStrip strip, const FrameAxis& axis) {
    const Extremes shown = extremesOf(view, strip, axis.frameAt(axis.left()), axis.endFrame());
    return number(strip, shown.low) + " – " + number(strip, shown.high) + stripStyle(strip).unit;
}

void drawStrip(const TimelineView& view, TimelineStrip strip, const FrameAxis& axis, float top,
               float bottom) {
    const double scale = topOf(view, strip);
    const float height = bottom - top - scaled(3);
    const auto yOf = [&](double value) {
        return bottom - static_cast<float>(value / scale) * height;
    };
    const auto columns = withValues(view, strip, [&](const auto& values) {
        return plotColumns(axis, view.frame_count, [&](int i) { return values[i]; });
    });
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 line = colorOf(strip, 1.0F);
    const ImU32 fill = colorOf(strip, 0.22F);
    const float stroke = std::max(1.0F, scaled(1.5F));
    double before = columns.empty() ? 0.0 : columns.front().low;
    for (std::size_t x = 0; x < columns.size(); ++x) {
        const PlotColumn& column = columns[x];
        const float left = static_cast<float>(axis.left()) + static_cast<float>(x);
        // Connected to the previous column, so that a steep change is a line instead of two dots.
        const float high = yOf(std::max(column.high, before));
        const float low = std::max(yOf(std::min(column.low, before)), high + stroke);
        list->AddRectFilled({left, high}, {left + 1, std::min(low, bottom)}, line);
        list->AddRectFilled({left, std::min(low, bottom)}, {left + 1, bottom}, fill);
        before = column.last;
    }
    if (const double limit = limitOf(view, strip); limit > 0.0) {
        const float y = yOf(limit);
        const bool is_least = strip == TimelineStrip::Clearance ||
                              strip == TimelineStrip::ImageCorners ||
                              strip == TimelineStrip::Overlap;
        const ImU32 color = ImGui::GetColorU32(is_least ? palette().bad : palette().warning);
        for (auto x = static_cast<float>(axis.left()); x < axis.right(); x += scaled(7)) {
            const float end = std::min(x + scaled(4), static_cast<float>(axis.right()));
            list->AddLine({x, y}, {end, y}, color);
        }
    }
}

bool drawEarlierStrip(const TimelineView& view, TimelineStrip strip, const FrameAxis& axis,
                      float top, float bottom) {
    const TimelineView before = earlierView(view, strip);
    if (before.frame_count == 0) return false;
    const double stretch = static_cast<double>(before.frame_count) / view.frame_count;
    const FrameAxis stretched(before.frame_count, axis.left(), axis.right(), axis.first() * stretch,
                              axis.shown() * stretch, axis.margin() * stretch);
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 0.45F);
    drawStrip(before, strip, stretched, top, bottom);
    ImGui::PopStyleVar();
    return true;
}

}  // namespace dollytrack::ui
