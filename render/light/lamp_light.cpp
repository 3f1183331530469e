#include "render/light/lamp_light.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr int kShadowRays = 6;  // per lamp and point
constexpr std::size_t kNearestSceneLamps = 6;
constexpr int kSceneLampShadowRays = 9;
constexpr double kOffSurface = 2e-3;  // m; offset of lit points from their surface

class SceneLampGatherer {
  public:
    SceneLampGatherer(const LightRig& rig, const RayCaster& rays, const IrradianceGrid& cells,
                      const LightBounces& bounces)
        : rig_(rig), rays_(rays), cells_(cells), bounces_(bounces) {}

    [[nodiscard]] Eigen::Vector3f at(std::size_t cell) const {
        Random random(18, cell);
        const Eigen::Vector3d from = cells_.center(cell);
        std::vector<std::pair<double, const SceneLamp*>> near;  // sorted by unshadowed strength
        for (const SceneLamp& lamp : rig_.scene_lamps) {
            const double squared = (lamp.position - from).squaredNorm();
            if (squared < kLampReach_m * kLampReach_m)
                near.emplace_back(-lamp.intensity / squared, &lamp);
        }
        std::sort(near.begin(), near.end());  // ties: by position in the array
        if (near.size() > kNearestSceneLamps) near.resize(kNearestSceneLamps);
        const bool free = standsFree(cell);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const auto& [unshaded, lamp] : near) {
            const Eigen::Vector3d on = litPlace(cell, *lamp);
            const Eigen::Vector3d way = lamp->position - on;
            // Below the grid's resolution the distance is that to the lamp itself.
            const double least = std::max(lamp->radius_m, 0.5 * cells_.size_m());
            const double squared = std::max(way.squaredNorm(), least * least);
            sum += way.normalized() *
                   (lamp->intensity / squared * visibleShare(from, free, on, *lamp, random));
        }
        return sum.cast<float>();
    }

  private:
    /// Whether no ray of the cell hits anything within the cell.
    [[nodiscard]] bool standsFree(std::size_t cell) const {
        const double corner = 0.5 * std::sqrt(3.0) * cells_.size_m();
        for (std::size_t k = 0; k < bounces_.perCell(); ++k) {
            const float distance_m = bounces_.of(cell, k).distance_m;
            if (distance_m > 0.0F && distance_m < corner) return false;
        }
        return true;
    }

    /// The grid is sampled at an offset from surfaces, so light is computed at the nearest surface
    /// point that faces the lamp and is not part of it; else at the cell's centre.
    [[nodiscard]] Eigen::Vector3d litPlace(std::size_t cell, const SceneLamp& lamp) const {
        const Eigen::Vector3d from = cells_.center(cell);
        Eigen::Vector3d nearest = from;
        double least = 2.1 * cells_.size_m();  // twice the sampling offset, because cells are
                                               // interpolated
        for (std::size_t k = 0; k < bounces_.perCell(); ++k) {
            const LightBounce& ray = bounces_.of(cell, k);
            if (ray.isSky() || ray.distance_m > 4.0 * cells_.size_m()) continue;
            const Eigen::Vector3d way = bounces_.way(cell, k);
            const Eigen::Vector3d normal = ray.normal().cast<double>();
            const double off = -ray.distance_m * normal.dot(way);
            if (off >= least || lamp.shade.contains(from + ray.distance_m * way)) continue;
            const Eigen::Vector3d on = from - (off - kOffSurface) * normal;
            if (normal.dot(lamp.position - on) <= 0.0) continue;
            least = off;
            nearest = on;
        }
        return nearest;
    }

    /// Visible share of the lamp's ball from random points in the cell. Unless the cell is free,
    /// only points visible from its centre count.
    [[nodiscard]] double visibleShare(const Eigen::Vector3d& middle, bool free,
                                      const Eigen::Vector3d& at, const SceneLamp& lamp,
                                      Random& random) const {
        int asked = 0;
        int visible = 0;
        for (int k = 0; k < kSceneLampShadowRays; ++k) {
            Eigen::Vector3d aside;
            Eigen::Vector3d on_ball;
            for (int axis = 0; axis < 3; ++axis) aside[axis] = random.uniform(-0.5, 0.5);
            for (int axis = 0; axis < 3; ++axis) on_ball[axis] = random.uniform(-1.0, 1.0);
            // Random points stay on the surface if there is one.
            const Eigen::Vector3d off = middle - at;
            if (off.squaredNorm() > 1e-8) aside -= off * (off.dot(aside) / off.squaredNorm());
            const Eigen::Vector3d from = k == 0 ? at : at + cells_.size_m() * aside;
            if (k != 0 && !free && !rays_.sees(middle, from)) continue;
            ++asked;
            const Eigen::Vector3d to =
                lamp.position + 0.8 * lamp.radius_m / std::max(on_ball.norm(), 1.0) * on_ball;
            const double distance = (to - from).norm();
            const Eigen::Vector3d way = (to - from) / distance;
            const double end = lamp.shadowedFor(from, way, distance);
            if (end <= 0.0 || rays_.sees(from, from + end * way)) ++visible;
        }
        return static_cast<double>(visible) / asked;
    }

    const LightRig& rig_;
    const RayCaster& rays_;
    const IrradianceGrid& cells_;
    const LightBounces& bounces_;
};

}  // namespace

Eigen::Vector3f roomLampsAt(const Eigen::Vector3d& place, const LightRig& rig,
                            const RayCaster& rays, Random& random) {
    std::vector<std::pair<double, const Lamp*>> near;  // sorted by unshadowed strength
    for (const Lamp& lamp : rig.lamps) {
        const Eigen::Vector3d way = lamp.position - place;
        const double squared = way.squaredNorm() + lamp.radius_m * lamp.radius_m;
        if (way.z() <= 0.0 || squared > kLampReach_m * kLampReach_m) continue;
        near.emplace_back(lamp.intensity * way.z() / (squared * std::sqrt(squared)), &lamp);
    }
    std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    if (near.size() > rig.lamps_per_point) near.resize(rig.lamps_per_point);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [unshaded, lamp] : near) {
        const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
        for (int k = 0; k < kShadowRays; ++k) {
            const double angle = turn + k * 2.0 * std::numbers::pi / kShadowRays;
            const double r = lamp->radius_m * std::sqrt((k + random.uniform()) / kShadowRays);
            const Eigen::Vector3d on =
                lamp->position + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0);
            const Eigen::Vector3d way = on - place;
            const double distance = way.norm();
            const double down = way.z() / distance;
            const double free = std::max(0.0, 1.0 - kLampShade / distance);  // see light_rig.h
            if (down <= 0.0 || !rays.sees(place, place + free * way)) continue;
            const double strength = lamp->radiance() * lamp->area() * down / (distance * distance);
            sum += way * (strength / distance / kShadowRays);
        }
    }
    return sum.cast<float>();
}

std::vector<Eigen::Vector3f> sceneLampsByCell(const LightRig& rig, const RayCaster& rays,
                                              const IrradianceGrid& cells,
                                              const LightBounces& bounces, const JobContext& job) {
    std::vector<Eigen::Vector3f> result(cells.count());
    const SceneLampGatherer gatherer(rig, rays, cells, bounces);
    constexpr std::size_t kPiece = 8192;  // cells between two progress reports
    for (std::size_t begin = 0; begin < result.size() && !job.cancelled(); begin += kPiece) {
        job.report(static_cast<double>(begin) / static_cast<double>(result.size()));
        const std::size_t piece = std::min(kPiece, result.size() - begin);
        parallelRanges(piece, 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) result[begin + i] = gatherer.at(begin + i);
        });
    }
    cells.closeHoles(result);
    return result;
}

}  // namespace dollytrack::render
