#include "planning/motions/repair_stretch.h"

#include "planning/collision/mapped_scene.h"
#include "planning/collision/swept_sphere.h"
#include "planning/motions/free_way.h"
#include "planning/motions/relax_way.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

using Polyline = std::vector<Eigen::Vector3d>;

constexpr double kSpacing = 0.05;     // of the points of a repaired stretch, m
constexpr double kMostPoints = 2000;  // of a repaired stretch; longer ones have larger spacings
constexpr double kStanding = 0.001;   // m; added to each given move, so that a camera that stands
                                      // and turns has a share of the way as well
constexpr int kRoundings = 2;         // rounds of cutting corners
// A way longer than this many times the given one, plus a metre, is a detour.
constexpr double kDetour = 2.0;

double lengthOf(const Polyline& way) {
    double length = 0.0;
    for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
    return length;
}

/// Frames `first` to `last` of the given motion, with a parameter 0..1 that grows with the way.
class GivenStretch {
  public:
    GivenStretch(std::span<const TrajectoryFrame> frames, std::size_t first, std::size_t last)
        : first_(first) {
        for (std::size_t i = first; i <= last; ++i) {
            const Eigen::Vector3d& position = frames[i].pose.position;
            if (!positions_.empty()) {
                const double move = (position - positions_.back()).norm();
                length_ += move;
                arcs_.push_back(arcs_.back() + move + kStanding);
            }
            positions_.push_back(position);
        }
    }

    [[nodiscard]] double length() const { return length_; }

    /// The point there, with its frame.
    [[nodiscard]] PathPoint at(double share) const {
        const double arc = share * arcs_.back();
        const auto after = std::upper_bound(arcs_.begin(), arcs_.end(), arc);
        const auto i = std::clamp<std::ptrdiff_t>(after - arcs_.begin() - 1, 0,
                                                  static_cast<std::ptrdiff_t>(arcs_.size()) - 2);
        const auto k = static_cast<std::size_t>(i);
        const double part = std::clamp((arc - arcs_[k]) / (arcs_[k + 1] - arcs_[k]), 0.0, 1.0);
        return {positions_[k] + part * (positions_[k + 1] - positions_[k]),
                static_cast<double>(first_ + k) + part, true};
    }

    [[nodiscard]] Polyline sampled(double spacing) const {
        const double parts = std::clamp(std::ceil(length_ / spacing), 1.0, kMostPoints);
        Polyline points;
        for (double k = 0.0; k <= parts; k += 1.0) points.push_back(at(k / parts).position);
        return points;
    }

  private:
    std::size_t first_;
    double length_ = 0.0;
    Polyline positions_;
    std::vector<double> arcs_ = {0.0};
};

/// Divides the moves of a way, so that it has a point at least every kSpacing along itself and
/// along the given motion.
Polyline divided(const Polyline& way, const GivenStretch& given) {
    const double length = lengthOf(way);
    const double wanted = std::clamp(std::max(length, given.length()) / kSpacing, 1.0, kMostPoints);
    Polyline points = {way.front()};
    for (std::size_t i = 1; i < way.size(); ++i) {
        const double share = length > 0.0 ? (way[i] - way[i - 1]).norm() / length : 1.0;
        const double parts = std::max(1.0, std::ceil(share * wanted));
        for (double k = 1.0; k <= parts; k += 1.0) {
            points.push_back(way[i - 1] + k / parts * (way[i] - way[i - 1]));
        }
    }
    if (points.size() == 1) points.push_back(way.front());
    return points;
}

/// Cuts corners where that is proven free (Chaikin 1974).
void roundCorners(const SweptSphere& sphere, std::vector<PathPoint>& points) {
    const auto between = [](const PathPoint& a, const PathPoint& b, double share) {
        return PathPoint{a.position + share * (b.position - a.position),
                         a.frame + share * (b.frame - a.frame), true};
    };
    std::vector<PathPoint> rounded = {points.front()};
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const PathPoint before = between(points[i], points[i - 1], 0.25);
        const PathPoint after = between(points[i], points[i + 1], 0.25);
        if (sphere.segment(before.position, after.position).free) {
            rounded.push_back(before);
            rounded.push_back(after);
        } else {
            rounded.push_back(points[i]);
        }
    }
    rounded.push_back(points.back());
    points = std::move(rounded);
}

/// Adds a point for each given frame between the points.
std::vector<PathPoint> withFrames(const std::vector<PathPoint>& points) {
    std::vector<PathPoint> all;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const PathPoint& from = points[i];
        const PathPoint& to = points[i + 1];
        all.push_back(from);
        for (double frame = std::floor(from.frame) + 1.0; frame < to.frame; frame += 1.0) {
            const double share = (frame - from.frame) / (to.frame - from.frame);
            all.push_back({from.position + share * (to.position - from.position), frame, true});
        }
    }
    all.push_back(points.back());
    all.back().repaired_next = false;
    return all;
}

}  // namespace

void findWay(const MappedScene& scene, std::span<const TrajectoryFrame> frames,
             const JobContext& job, Stretch& stretch) {
    const GivenStretch given(frames, stretch.first, stretch.last);
    const Polyline along = given.sampled(2.0 * kSpacing);
    const bool backwards = !stretch.start;
    const Eigen::Vector3d& from = backwards ? *stretch.end : *stretch.start;
    WayEnd to{backwards ? along.front() : along.back(), false};
    if (stretch.start && stretch.end) to = {*stretch.end, true};
    stretch.way = findFreeWay(scene, from, to, along, job);
    if (!stretch.way) return;
    if (backwards) std::reverse(stretch.way->begin(), stretch.way->end());
    stretch.is_detour = lengthOf(*stretch.way) > kDetour * given.length() + 1.0;
}

std::vector<PathPoint> pointsOf(const MappedScene& scene, std::span<const TrajectoryFrame> frames,
                                const Stretch& stretch, const JobContext& job) {
    const GivenStretch given(frames, stretch.first, stretch.last);
    Polyline way = divided(*stretch.way, given);
    std::vector<PathPoint> points(way.size());
    Polyline targets(way.size());
    const double length = lengthOf(way);
    double arc = 0.0;
    for (std::size_t i = 0; i < way.size(); ++i) {
        if (i > 0) arc += (way[i] - way[i - 1]).norm();
        const double share = length > 0.0
                                 ? std::min(1.0, arc / length)
                                 : static_cast<double>(i) / static_cast<double>(way.size() - 1);
        points[i] = given.at(i + 1 == way.size() ? 1.0 : share);
        targets[i] = points[i].position;
    }
    relaxWay(scene, targets, !stretch.start, !stretch.end, job, way);
    for (std::size_t i = 0; i < way.size(); ++i) points[i].position = way[i];
    for (int round = 0; round < kRoundings; ++round) roundCorners(*scene.sphere, points);
    points.front().frame = static_cast<double>(stretch.first);
    points.back().frame = static_cast<double>(stretch.last);
    return withFrames(points);
}

}  // namespace dollytrack::planning
