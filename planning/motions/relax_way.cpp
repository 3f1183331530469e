#include "planning/motions/relax_way.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/mapped_scene.h"
#include "planning/collision/swept_sphere.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

constexpr double kFade = 0.15;      // distance over which a shift fades, m
constexpr double kStiffest = 40.0;  // largest weight of a change of shift; stiffer bands need more
                                    // sweeps
constexpr int kSweeps = 80;
constexpr double kSettled = 0.0005;  // m; ends when no point moves farther
constexpr int kTries = 4;            // of a point in a sweep, each half as far

class Band {
  public:
    Band(const MappedScene& scene, const std::vector<Eigen::Vector3d>& targets,
         std::vector<Eigen::Vector3d>& way)
        : scene_(scene), targets_(targets), way_(way) {
        double length = 0.0;
        for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
        const double spacing = length / static_cast<double>(way.size() - 1);
        stiffness_ = std::clamp(kFade * kFade / (spacing * spacing + 1e-9), 1.0, kStiffest);
    }

    /// Moves a point towards its optimum between its neighbours, along the nearest surface where
    /// that is in the way. Returns how far it moved.
    double improve(std::size_t i) {
        const Eigen::Vector3d from = way_[i];
        Eigen::Vector3d move = scene_.sphere->onHeight(optimumOf(i)) - from;
        if (move.norm() < kSettled) return 0.0;
        if (tryPlace(i, from + move)) return move.norm();
        move = alongSurface(from, move);
        for (int k = 0; k < kTries && move.norm() >= kSettled; ++k, move *= 0.5) {
            if (tryPlace(i, scene_.sphere->onHeight(from + move))) return move.norm();
        }
        return 0.0;
    }

  private:
    [[nodiscard]] Eigen::Vector3d optimumOf(std::size_t i) const {
        Eigen::Vector3d shifts = Eigen::Vector3d::Zero();
        double weight = 1.0;
        const auto add = [&](std::size_t neighbour) {
            shifts += stiffness_ * (way_[neighbour] - targets_[neighbour]);
            weight += stiffness_;
        };
        if (i > 0) add(i - 1);
        if (i + 1 < way_.size()) add(i + 1);
        return targets_[i] + shifts / weight;
    }

    [[nodiscard]] Eigen::Vector3d alongSurface(const Eigen::Vector3d& from,
                                               const Eigen::Vector3d& move) const {
        const double reach = scene_.sphere->radius() + SweptSphere::kMargin;
        const ClosestPoint closest = scene_.rays->closest(from, reach + move.norm());
        if (closest.object_id == 0 || closest.distance <= 0.0) return move;
        const Eigen::Vector3d normal = (from - closest.point) / closest.distance;
        const double room = std::max(0.0, closest.distance - reach);
        const double into = -move.dot(normal) - room;
        return into > 0.0 ? move + into * normal : move;
    }

    bool tryPlace(std::size_t i, const Eigen::Vector3d& place) {
        const SweptSphere& sphere = *scene_.sphere;
        if (!sphere.fits(place)) return false;
        if (i > 0 && !sphere.segment(way_[i - 1], place).free) return false;
        if (i + 1 < way_.size() && !sphere.segment(place, way_[i + 1]).free) return false;
        way_[i] = place;
        return true;
    }

    const MappedScene& scene_;
    const std::vector<Eigen::Vector3d>& targets_;
    std::vector<Eigen::Vector3d>& way_;
    double stiffness_;
};

}  // namespace

void relaxWay(const MappedScene& scene, const std::vector<Eigen::Vector3d>& targets,
              bool free_start, bool free_end, const JobContext& job,
              std::vector<Eigen::Vector3d>& way) {
    if (way.size() < 2) return;
    Band band(scene, targets, way);
    const std::size_t begin = free_start ? 0 : 1;
    const std::size_t end = free_end ? way.size() : way.size() - 1;
    for (int sweep = 0; sweep < kSweeps && !job.cancelled(); ++sweep) {
        double farthest = 0.0;
        for (std::size_t k = begin; k < end; ++k) {
            // Every other sweep runs backwards, so that shifts spread in both directions.
            const std::size_t i = sweep % 2 == 0 ? k : begin + (end - 1 - k);
            farthest = std::max(farthest, band.improve(i));
        }
        if (farthest < kSettled) break;
    }
}

}  // namespace dollytrack::planning
