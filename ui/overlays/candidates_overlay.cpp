#include "ui/overlays/candidates_overlay.h"

#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::ui {
namespace {

using Mark = render::OverlayMark;
using EntryShape = LegendEntry::Shape;

// Refused candidates fill much of the room; smaller marks keep the room visible.
constexpr double kLegal_px = 8.0;
constexpr double kRefused_px = 3.5;
constexpr int kConeSides = 36;
const Eigen::Vector4f kCone(0.98F, 0.85F, 0.35F, 1.0F);

double halfAngle(const CandidatesOverlayOptions& options) {
    return std::min(options.cone_half_angle_deg, 89.0) * std::numbers::pi / 180.0;
}

/// Distance of the farthest candidate inside the cone, m; 0 if there is none. Candidates outside
/// the room count only if there are no others.
double coneLength(const ObservationPoint& point, const std::vector<Candidate>& candidates,
                  double half_angle) {
    double length = 0.0;
    double outside = 0.0;
    for (const Candidate& candidate : candidates) {
        const Eigen::Vector3d way = candidate.position - point.position;
        const double distance = way.norm();
        if (distance <= 0.0) continue;
        if (way.dot(point.direction) / distance < std::cos(half_angle) - 1e-3) continue;
        double& reach = candidate.verdict == Verdict::OutsideRoom ? outside : length;
        reach = std::max(reach, distance);
    }
    return length > 0.0 ? length : outside;
}

/// The search cone, with its apex at the observation point.
void addCone(render::Overlay& overlay, const ObservationPoint& point,
             const std::vector<Candidate>& candidates, const CandidatesOverlayOptions& options) {
    const double half_angle = halfAngle(options);
    const double length = coneLength(point, candidates, half_angle);
    if (length <= 0.0) return;
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), point.direction);
    const auto rim = [&](int i) {
        const double angle = 2.0 * std::numbers::pi * i / kConeSides;
        const Eigen::Vector3d way(std::sin(half_angle) * std::cos(angle),
                                  std::sin(half_angle) * std::sin(angle), std::cos(half_angle));
        return Eigen::Vector3d(point.position + length * (turn * way));
    };
    for (int i = 0; i < kConeSides; ++i) {
        if (options.cone_filled) {
            overlay.triangles.push_back(
                {point.position, rim(i), rim(i + 1), withOpacity(kCone, 0.16F)});
        }
        overlay.lines.push_back({rim(i), rim(i + 1), withOpacity(kCone, 0.9F), 1.5});
        if (i % 9 == 0) {
            overlay.lines.push_back({point.position, rim(i), withOpacity(kCone, 0.6F), 1.2});
        }
    }
    overlay.lines.push_back({point.position, point.position + length * point.direction,
                             withOpacity(kCone, 0.8F), 1.2, 5.0});
}

}  // namespace

std::string_view inWords(Verdict verdict) {
    switch (verdict) {
        case Verdict::Legal:
            return "legal";
        case Verdict::InObstacle:
            return "in an obstacle";
        case Verdict::OutsideRoom:
            return "outside the room";
        case Verdict::OccludedBy:
            return "occluded";
        case Verdict::TooClose:
            return "too close";
        case Verdict::Cropped:
            return "cropped by the image";
        case Verdict::TooSmall:
            return "too small in the image";
        case Verdict::NoGo:
            return "in a no-go box";
        case Verdict::HeightBand:
            return "outside the height band";
        case Verdict::PitchBand:
            return "outside the pitch band";
        case Verdict::InGap:
            return "in a gap";
        case Verdict::Unscanned:
            return "mostly unscanned in the image";
    }
    return "";
}

Eigen::Vector4f colorOf(Verdict verdict) {
    switch (verdict) {
        case Verdict::Legal:
            return {0.20F, 0.78F, 0.30F, 1.0F};
        case Verdict::InObstacle:
            return {0.85F, 0.15F, 0.15F, 1.0F};
        case Verdict::OutsideRoom:
            return {0.45F, 0.45F, 0.50F, 1.0F};
        case Verdict::OccludedBy:
            return {0.97F, 0.55F, 0.10F, 1.0F};
        case Verdict::TooClose:
            return {0.62F, 0.30F, 0.85F, 1.0F};
        case Verdict::Cropped:
            return {0.16F, 0.50F, 0.90F, 1.0F};
        case Verdict::TooSmall:
            return {0.60F, 0.42F, 0.25F, 1.0F};
        case Verdict::NoGo:
            return {0.85F, 0.15F, 0.55F, 1.0F};
        case Verdict::HeightBand:
            return {0.45F, 0.70F, 0.75F, 1.0F};
        case Verdict::PitchBand:
            return {0.75F, 0.70F, 0.45F, 1.0F};
        case Verdict::InGap:
            return {0.55F, 0.10F, 0.30F, 1.0F};
        case Verdict::Unscanned:
            return {0.25F, 0.25F, 0.30F, 1.0F};
    }
    return {1, 1, 1, 1};
}

bool isInCone(const Plan& plan, const CandidatesOverlayOptions& options,
              const Eigen::Vector3d& eye) {
    const std::size_t index = options.observation_point;
    if (options.observation_point < 0 ||
        index >= std::min(plan.observation_points.size(), plan.searches.size())) {
        return false;
    }
    // Margin around the cone: a side this close covers as much of the image as from inside.
    constexpr double kTouching_m = 0.15;
    // Beyond twice the cone's length, its base fits into the image.
    constexpr double kMouth = 2.0;
    const ObservationPoint& point = plan.observation_points[index];
    const double half_angle = halfAngle(options);
    const double length = coneLength(point, plan.searches[index].candidates, half_angle);
    const Eigen::Vector3d apex =
        point.position - kTouching_m / std::sin(half_angle) * point.direction.normalized();
    const Eigen::Vector3d way = eye - apex;
    return length > 0.0 && (eye - point.position).norm() < kMouth * length &&
           way.dot(point.direction.normalized()) > std::cos(half_angle) * way.norm();
}

PlanLayer candidatesLayer(const Plan& plan, const CandidatesOverlayOptions& options) {
    PlanLayer layer;
    layer.legend.title = "Candidates";
    const int index = options.observation_point;
    const auto count =
        static_cast<int>(std::min(plan.observation_points.size(), plan.searches.size()));
    if (index < 0 || index >= count) return layer;
    const ObservationPoint& point = plan.observation_points[index];
    const ViewpointSearch& search = plan.searches[index];
    if (options.cone) {
        addCone(layer.overlay, point, search.candidates, options);
    }
    std::array<int, kVerdicts> counts{};
    for (std::size_t i = 0; i < search.candidates.size(); ++i) {
        const Candidate& candidate = search.candidates[i];
        ++counts[static_cast<std::size_t>(candidate.verdict)];
        if (!options.shown[static_cast<std::size_t>(candidate.verdict)]) continue;
        const bool legal = candidate.verdict == Verdict::Legal;
        layer.overlay.marks.push_back({candidate.position,
                                       Mark::Shape::Dot,
                                       colorOf(candidate.verdict),
                                       legal ? kLegal_px : kRefused_px,
                                       {0, 0, 0},
                                       toTag(Picked::Candidate, static_cast<int>(i))});
    }
    layer.overlay.marks.push_back({point.position,
                                   Mark::Shape::Dot,
                                   kLargeTargetColor,
                                   12.0,
                                   {0, 0, 0},
                                   toTag(Picked::ObservationPoint, index)});
    auto& entries = layer.legend.entries;
    entries.push_back({"Observation point", EntryShape::Dot, kLargeTargetColor, 1});
    for (std::size_t verdict = 0; verdict < kVerdicts; ++verdict) {
        const int number = counts[verdict];
        if (number == 0) continue;
        const auto kind = static_cast<Verdict>(verdict);
        std::string words(inWords(kind));
        words[0] = static_cast<char>(words[0] - 'a' + 'A');
        if (!options.shown[verdict]) words += " (not drawn)";
        entries.push_back({std::move(words), EntryShape::SmallDot, colorOf(kind), number});
    }
    if (search.position_point >= 0) {
        const Eigen::Vector3d& best = plan.position_points[search.position_point].pose.position;
        const std::int32_t tag = toTag(Picked::PositionPoint, search.position_point);
        layer.overlay.lines.push_back({best, point.position, kKeyFrameColor, 2.0, 0.0, tag});
        layer.overlay.marks.push_back(
            {best, Mark::Shape::Ring, kKeyFrameColor, 16.0, {0, 0, 0}, tag});
        layer.overlay.marks.push_back(
            {best, Mark::Shape::Cross, kKeyFrameColor, 9.0, {0, 0, 0}, tag});
        entries.push_back({"Taken", EntryShape::Ring, kKeyFrameColor, 1});
    }
    const int selected = options.selected_candidate;
    if (selected >= 0 && selected < static_cast<int>(search.candidates.size())) {
        const Eigen::Vector3d& at = search.candidates[selected].position;
        const std::int32_t tag = toTag(Picked::Candidate, selected);
        layer.overlay.lines.push_back({at, point.position, kSelectedColor, 1.6, 5.0, tag});
        layer.overlay.marks.push_back(
            {at, Mark::Shape::Ring, kSelectedColor, 16.0, {0, 0, 0}, tag});
        entries.push_back({"Selected", EntryShape::Ring, kSelectedColor, 1});
    }
    return layer;
}

}  // namespace dollytrack::ui
