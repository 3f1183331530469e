#include "ui/overlays/quality_overlay.h"

#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <fmt/format.h>

namespace dollytrack::ui {
namespace {

using Mark = render::OverlayMark;
using Shape = LegendEntry::Shape;

constexpr double kStretchWidth = 8.0;  // px; the trajectory's line is 3.6
constexpr double kDot = 8.0;           // px, where the camera turns on the spot
constexpr double kCross = 13.0;        // px
constexpr double kSquare = 11.0;       // px
constexpr double kDash = 7.0;          // px

bool fits(const Plan& plan, const FrameQuality& quality) {
    const std::size_t frames = plan.trajectory.frames.size();
    return quality.image_corners.size() == frames && quality.overlap.size() == frames;
}

/// The way to a frame from the one before, and a mark at the frame, which is visible where the
/// camera only turns.
void addFrame(render::Overlay& overlay, const Trajectory& trajectory, std::size_t frame,
              const render::OverlayLine& style, Mark mark) {
    const Eigen::Vector3d& at = trajectory.frames[frame].pose.position;
    const std::int32_t tag = toTag(Picked::Frame, static_cast<int>(frame));
    if (continuesPath(trajectory, frame)) {
        render::OverlayLine line = style;
        line.a = trajectory.frames[frame - 1].pose.position;
        line.b = at;
        line.tag = tag;
        overlay.lines.push_back(line);
    }
    mark.at = at;
    mark.rgba = style.rgba;
    mark.tag = tag;
    overlay.marks.push_back(mark);
}

void addUnusable(PlanLayer& layer, const Trajectory& trajectory,
                 const std::vector<render::PictureQuality>& pictures) {
    if (pictures.size() != trajectory.frames.size()) return;
    int unusable = 0;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (pictures[i] == render::PictureQuality::Usable) continue;
        ++unusable;
        layer.overlay.marks.push_back({trajectory.frames[i].pose.position,
                                       Mark::Shape::Square,
                                       kUnusableColor,
                                       kSquare,
                                       {0, 0, 0},
                                       toTag(Picked::Frame, static_cast<int>(i))});
    }
    layer.legend.entries.push_back(
        {"Dark, white or flat image", Shape::Block, kUnusableColor, unusable});
}

}  // namespace

PlanLayer qualityLayer(const Plan& plan, const FrameQuality& quality,
                       const PictureClasses& pictures, const QualityOverlayOptions& options) {
    PlanLayer layer;
    if (!fits(plan, quality)) return layer;
    layer.legend.title = "Weak frames";
    const Trajectory& trajectory = plan.trajectory;
    render::OverlayLine stretch;
    stretch.rgba = kWarningColor;
    stretch.width_px = kStretchWidth;
    render::OverlayLine gap;
    gap.rgba = kGapColor;
    gap.width_px = 0.5 * kStretchWidth;
    gap.dash_px = kDash;
    Mark dot;
    dot.size_px = kDot;
    Mark cross;
    cross.shape = Mark::Shape::Cross;
    cross.size_px = kCross;
    int untrackable = 0;
    int gaps = 0;
    for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
        if (options.untrackable && isUntrackable(quality.image_corners[i])) {
            ++untrackable;
            addFrame(layer.overlay, trajectory, i, stretch, dot);
        }
    }
    // Gaps are drawn over the stretches.
    for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
        if (options.wide_gaps && continuesPath(trajectory, i) && isWideGap(quality.overlap[i])) {
            ++gaps;
            addFrame(layer.overlay, trajectory, i, gap, cross);
        }
    }
    if (options.unusable && pictures) addUnusable(layer, trajectory, *pictures);
    if (options.untrackable) {
        layer.legend.entries.push_back(
            {fmt::format("Fewer than {:.0f} image corners", kTrackableCorners), Shape::Line,
             kWarningColor, untrackable});
    }
    if (options.wide_gaps) {
        layer.legend.entries.push_back(
            {fmt::format("Overlap below {:.0f} %", 100.0 * kLeastOverlap), Shape::Cross, kGapColor,
             gaps});
    }
    return layer;
}

std::string qualityText(const Plan& plan, const FrameQuality& quality,
                        const PictureClasses& pictures, int frame) {
    const auto i = static_cast<std::size_t>(frame);
    if (!fits(plan, quality) || frame < 0 || i >= quality.overlap.size()) return {};
    const double corners = quality.image_corners[i];
    std::string text = fmt::format("{:.0f} image corners", corners);
    if (isUntrackable(corners)) text += fmt::format(", {:.0f} needed", kTrackableCorners);
    if (pictures && i < pictures->size() && (*pictures)[i] != render::PictureQuality::Usable) {
        text += fmt::format("\n{} image",
                            render::kPictureQualities[static_cast<std::size_t>((*pictures)[i])]);
    }
    if (!continuesPath(plan.trajectory, i)) return text;
    text += fmt::format("\n{:.0f} % shared with the frame before", 100.0 * quality.overlap[i]);
    if (isWideGap(quality.overlap[i]))
        text += fmt::format(", {:.0f} % needed", 100.0 * kLeastOverlap);
    return text;
}

}  // namespace dollytrack::ui
