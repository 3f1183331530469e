#include "ui/overlays/quality_overlay.h"

#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <fmt/format.h>

namespace dollytrack::ui {
namespace {

using Mark = render::OverlayMark;
using Shape = LegendEntry::Shape;

constexpr double kStretchWidth = 8.0;  // px; the trajectory's line is 3.6
constexpr double kDot = 9.0;           // px, where a stretch begins
constexpr double kCross = 13.0;        // px
constexpr double kSquare = 11.0;       // px
constexpr double kDash = 7.0;          // px

bool fits(const Plan& plan, const FrameQuality& quality) {
    const std::size_t frames = plan.trajectory.frames.size();
    return quality.image_corners.size() == frames && quality.overlap.size() == frames;
}

void addMark(render::Overlay& overlay, const Trajectory& trajectory, std::size_t frame,
             Mark::Shape shape, const Eigen::Vector4f& rgba, double size_px) {
    overlay.marks.push_back({trajectory.frames[frame].pose.position,
                             shape,
                             rgba,
                             size_px,
                             {0, 0, 0},
                             toTag(Picked::Frame, static_cast<int>(frame))});
}

/// The way to a frame from the one before, if they are on one path.
void addWay(render::Overlay& overlay, const Trajectory& trajectory, std::size_t frame,
            render::OverlayLine line) {
    if (!continuesPath(trajectory, frame)) return;
    line.a = trajectory.frames[frame - 1].pose.position;
    line.b = trajectory.frames[frame].pose.position;
    line.tag = toTag(Picked::Frame, static_cast<int>(frame));
    overlay.lines.push_back(line);
}

/// Stretches of frames with few image corners. A dot marks where each begins, so that one is
/// visible that is short or where the camera turns on the spot.
void addUntrackable(PlanLayer& layer, const Trajectory& trajectory,
                    const std::vector<double>& corners) {
    render::OverlayLine line;
    line.rgba = kWarningColor;
    line.width_px = kStretchWidth;
    int untrackable = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (!isUntrackable(corners[i])) continue;
        ++untrackable;
        addWay(layer.overlay, trajectory, i, line);
        if (continuesPath(trajectory, i) && isUntrackable(corners[i - 1])) continue;
        addMark(layer.overlay, trajectory, i, Mark::Shape::Dot, kWarningColor, kDot);
    }
    layer.legend.entries.push_back(
        {fmt::format("Fewer than {:.0f} image corners", kTrackableCorners), Shape::Line,
         kWarningColor, untrackable});
}

void addWideGaps(PlanLayer& layer, const Trajectory& trajectory,
                 const std::vector<double>& overlap) {
    render::OverlayLine line;
    line.rgba = kGapColor;
    line.width_px = 0.5 * kStretchWidth;
    line.dash_px = kDash;
    int gaps = 0;
    for (std::size_t i = 0; i < overlap.size(); ++i) {
        if (!continuesPath(trajectory, i) || !isWideGap(overlap[i])) continue;
        ++gaps;
        addWay(layer.overlay, trajectory, i, line);
        addMark(layer.overlay, trajectory, i, Mark::Shape::Cross, kGapColor, kCross);
    }
    layer.legend.entries.push_back({fmt::format("Overlap below {:.0f} %", 100.0 * kLeastOverlap),
                                    Shape::Cross, kGapColor, gaps});
}

void addUnusable(PlanLayer& layer, const Trajectory& trajectory,
                 const std::vector<render::PictureQuality>& pictures) {
    if (pictures.size() != trajectory.frames.size()) return;
    int unusable = 0;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (pictures[i] == render::PictureQuality::Usable) continue;
        ++unusable;
        addMark(layer.overlay, trajectory, i, Mark::Shape::Square, kUnusableColor, kSquare);
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
    if (options.untrackable) addUntrackable(layer, plan.trajectory, quality.image_corners);
    // Gaps are drawn over the stretches.
    if (options.wide_gaps) addWideGaps(layer, plan.trajectory, quality.overlap);
    if (options.unusable && pictures) addUnusable(layer, plan.trajectory, *pictures);
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
