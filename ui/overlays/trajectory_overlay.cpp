#include "ui/overlays/trajectory_overlay.h"

#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::ui {
namespace {

using Mark = render::OverlayMark;
using Shape = LegendEntry::Shape;

constexpr double kWidth = 3.6;       // px
constexpr double kArrowEvery = 2.0;  // m
const Eigen::Vector4f kPlain(0.62F, 0.66F, 0.74F, 1.0F);

/// One value per frame, with its name and unit.
struct Values {
    std::vector<double> of_frame;
    LegendScale scale;
};

Values valuesOf(const Plan& plan, TrajectoryColor color) {
    const FrameSeries& series = plan.series;
    Values values;
    switch (color) {
        case TrajectoryColor::Time:
            for (const TrajectoryFrame& frame : plan.trajectory.frames) {
                values.of_frame.push_back(frame.time_s);
            }
            values.scale = {"Time", "s", 0.0, 0.0};
            break;
        case TrajectoryColor::Clearance:
            values.of_frame = series.clearance_m;
            values.scale = {"Clearance", "m", 0.0, 0.0};
            break;
        case TrajectoryColor::Speed:
            values.of_frame = series.speed_mps;
            values.scale = {"Speed", "m/s", 0.0, 0.0};
            break;
        case TrajectoryColor::TurnRate:
            values.of_frame = series.turn_dps;
            values.scale = {"Turn rate", "deg/s", 0.0, 0.0};
            break;
        case TrajectoryColor::Score:
            values.of_frame = series.score;
            values.scale = {"Score", "", 0.0, 0.0};
            break;
        case TrajectoryColor::NewlyCaptured:
            for (const std::vector<int>& objects : series.newly_captured) {
                values.of_frame.push_back(static_cast<double>(objects.size()));
            }
            values.scale = {"Newly captured", "objects", 0.0, 0.0};
            break;
        case TrajectoryColor::ImageCorners:
            values.of_frame = series.image_corners;
            values.scale = {"Image corners", "", 0.0, 0.0};
            break;
    }
    values.of_frame.resize(plan.trajectory.frames.size(), 0.0);
    for (const double value : values.of_frame) values.scale.max = std::max(values.scale.max, value);
    if (color == TrajectoryColor::ImageCorners) {
        // A fixed scale: more corners make no difference to SLAM programs.
        values.scale.max = series.image_corners.empty() ? 0.0 : 2.0 * kTrackableCorners;
    }
    // A dangerously low clearance must not blend in with moderately low ones.
    if (color == TrajectoryColor::Clearance && !values.of_frame.empty()) {
        values.scale.min = *std::min_element(values.of_frame.begin(), values.of_frame.end());
    }
    return values;
}

Eigen::Vector4f colorOf(const Values& values, std::size_t frame) {
    const double range = values.scale.max - values.scale.min;
    return scaleColor(range > 0.0 ? (values.of_frame[frame] - values.scale.min) / range : 0.0);
}

void addArrows(render::Overlay& overlay, const Trajectory& trajectory) {
    double since_last = 0.5 * kArrowEvery;
    for (std::size_t i = 1; i < trajectory.frames.size(); ++i) {
        const TrajectoryFrame& frame = trajectory.frames[i];
        const TrajectoryFrame& before = trajectory.frames[i - 1];
        if (!continuesPath(trajectory, i)) continue;
        const Eigen::Vector3d way = frame.pose.position - before.pose.position;
        since_last += way.norm();
        if (since_last < kArrowEvery || way.norm() < 1e-6) continue;
        since_last = 0.0;
        overlay.marks.push_back({frame.pose.position,
                                 Mark::Shape::Arrow,
                                 {1, 1, 1, 1},
                                 9.0,
                                 way.normalized(),
                                 toTag(Picked::Frame, static_cast<int>(i))});
    }
}

/// Draws the colliding segments of a given motion over the others.
void addCollisions(PlanLayer& layer, const Plan& plan) {
    constexpr double kCollisionWidth = 6.0;  // px
    int collisions = 0;
    for (const SmoothPath& path : plan.smooth_paths) {
        for (const SmoothPath::Piece& piece : path.pieces) {
            if (!piece.collides) continue;
            ++collisions;
            layer.overlay.lines.push_back({piece.start, piece.end, kRefusedColor, kCollisionWidth});
        }
    }
    if (collisions == 0) return;
    layer.legend.entries.push_back(
        {"Colliding segment", LegendEntry::Shape::Line, kRefusedColor, collisions});
}

}  // namespace

PlanLayer trajectoryLayer(const Plan& plan, const TrajectoryOverlayOptions& options) {
    PlanLayer layer;
    layer.legend.title = "Trajectory";
    const auto& frames = plan.trajectory.frames;
    const bool dots = options.color == TrajectoryColor::NewlyCaptured;
    const bool unknown =
        options.color == TrajectoryColor::ImageCorners && plan.series.image_corners.empty();
    const Values values = valuesOf(plan, options.color);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        // Between separate paths the camera was moved by other means: there is no motion to draw.
        if (!continuesPath(plan.trajectory, i)) continue;
        layer.overlay.lines.push_back({frames[i - 1].pose.position, frames[i].pose.position,
                                       dots || unknown ? kPlain : colorOf(values, i), kWidth, 0.0,
                                       toTag(Picked::Frame, static_cast<int>(i))});
    }
    if (options.direction_arrows) addArrows(layer.overlay, plan.trajectory);
    auto& entries = layer.legend.entries;
    if (dots) {
        int capturing = 0;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            if (values.of_frame[i] == 0.0) continue;
            ++capturing;
            layer.overlay.marks.push_back({frames[i].pose.position,
                                           Mark::Shape::Dot,
                                           colorOf(values, i),
                                           7.0 + 3.0 * std::sqrt(values.of_frame[i]),
                                           {0, 0, 0},
                                           toTag(Picked::Frame, static_cast<int>(i))});
        }
        entries.push_back(
            {"Frame that captures something new", Shape::Dot, scaleColor(1.0), capturing});
        entries.push_back({"Trajectory", Shape::Line, kPlain, static_cast<int>(frames.size())});
    } else if (unknown) {
        const bool measured = plan.series.size() == frames.size();
        entries.push_back(
            {measured ? "Frame (image corners need trackability=on)" : "Frame (being measured)",
             Shape::Line, kPlain, static_cast<int>(frames.size())});
    } else {
        entries.push_back({"Frame", Shape::Line, scaleColor(0.5), static_cast<int>(frames.size())});
    }
    addCollisions(layer, plan);
    if (values.scale.max > values.scale.min) layer.legend.scale = values.scale;
    const int selected = options.selected_frame;
    if (selected >= 0 && selected < static_cast<int>(frames.size())) {
        layer.overlay.marks.push_back({frames[selected].pose.position,
                                       Mark::Shape::Ring,
                                       kSelectedColor,
                                       18.0,
                                       {0, 0, 0},
                                       toTag(Picked::Frame, selected)});
        entries.push_back({"Selected frame", Shape::Ring, kSelectedColor, 1});
    }
    return layer;
}

PlanLayer keptPlanLayer(const Trajectory& trajectory, const std::string& name) {
    constexpr double kThin = 1.6;  // px
    PlanLayer layer;
    const auto& frames = trajectory.frames;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (!continuesPath(trajectory, i)) continue;
        layer.overlay.lines.push_back(
            {frames[i - 1].pose.position, frames[i].pose.position, kKeptPlanColor, kThin});
    }
    layer.legend.title = "Kept plan";
    layer.legend.entries.push_back(
        {"B: " + name, Shape::Line, kKeptPlanColor, static_cast<int>(frames.size())});
    return layer;
}

}  // namespace dollytrack::ui
