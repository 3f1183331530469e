#include "planning/motions/object_moves.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/mapped_scene.h"
#include "planning/collision/swept_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr double kFullCircle = 2.0 * std::numbers::pi;
constexpr double kShortestArc = kFullCircle / 18.0;
constexpr int kDirections = 16;  // tried around an object

Eigen::Vector3d horizontal(double angle_rad) {
    return {std::cos(angle_rad), std::sin(angle_rad), 0.0};
}

double angleOf(const Eigen::Vector3d& direction) {
    return std::atan2(direction.y(), direction.x());
}

}  // namespace

ObjectMoves::ObjectMoves(const MappedScene& scene, const Object& object)
    : scene_(scene),
      subject_(makeSubject(*scene.views, {object.id})),
      front_(object.front),
      object_id_(object.id) {}

ObjectMoves::ObjectMoves(const MappedScene& scene, const Eigen::Vector3d& center, double reach_m)
    : scene_(scene), subject_{center, {}}, reach_m_(reach_m) {}

double ObjectMoves::distanceFor(double fill) const {
    if (object_id_ == 0) return reach_m_ * 0.5 / fill;
    return distanceForFill(*scene_.views, subject_, front_, fill);
}

Orbit ObjectMoves::orbit(double radius_m, double z, double arc_rad, const JobContext& job) const {
    const double arc = std::min(arc_rad, kFullCircle);
    const auto steps = static_cast<int>(std::max(2.0, std::ceil(arc * radius_m / kMoveSpacing)));
    Orbit longest;
    Orbit run;
    // A full circle may start anywhere: a second round finds what crosses its start.
    const int rounds = arc_rad >= kFullCircle - 1e-9 ? 2 : 1;
    for (int k = 0; k <= rounds * steps; ++k) {
        job.report(static_cast<double>(k) / (rounds * steps));
        if (job.cancelled()) return {};
        const double angle = angleOf(front_) + arc * (static_cast<double>(k) / steps - 0.5);
        const auto place = placeAt(horizontal(angle), radius_m, z);
        const bool goes_on = place && (run.positions.empty() ||
                                       scene_.sphere->segment(run.positions.back(), *place).free);
        if (!goes_on) run = {};
        if (place) run.positions.push_back(*place);
        if (run.positions.size() > longest.positions.size()) longest = run;
        if (longest.positions.size() > static_cast<std::size_t>(steps)) break;
    }
    longest.share = (static_cast<double>(longest.positions.size()) - 1.0) / steps;
    if (arc * longest.share < std::min(kShortestArc, arc) - 1e-9) return {};
    return longest;
}

void ObjectMoves::smoothRadius(Orbit& orbit, double radius_m, const JobContext& job) const {
    constexpr int kSweeps = 60;
    constexpr int kTries = 3;          // of a position in a sweep, each half as far
    constexpr double kPull = 0.1;      // by the wanted radius; a change fades over 3 positions
    constexpr int kPulledSweeps = 40;  // the other sweeps only smooth
    constexpr double kSettled_m = 0.0002;
    std::vector<Eigen::Vector3d>& way = orbit.positions;
    const auto radiusOf = [&](std::size_t i) {
        return (way[i] - subject_.center).head<2>().norm();
    };
    const auto fitsBetween = [&](std::size_t i, const Eigen::Vector3d& place) {
        return scene_.sphere->fits(place) && isSeen(place) &&
               scene_.sphere->segment(way[i - 1], place).free &&
               scene_.sphere->segment(place, way[i + 1]).free;
    };
    for (int sweep = 0; sweep < kSweeps && !job.cancelled(); ++sweep) {
        const double pull = sweep < kPulledSweeps ? kPull : 0.0;
        for (std::size_t k = 1; k + 1 < way.size(); ++k) {
            // Every other sweep runs backwards, so that changes spread in both directions.
            const std::size_t i = sweep % 2 == 0 ? k : way.size() - 1 - k;
            const double here = radiusOf(i);
            const double wanted =
                (pull * radius_m + radiusOf(i - 1) + radiusOf(i + 1)) / (pull + 2.0);
            const Eigen::Vector3d out = horizontal(angleOf(way[i] - subject_.center));
            double change = wanted - here;
            for (int t = 0; t < kTries && std::abs(change) > kSettled_m; ++t, change *= 0.5) {
                const Eigen::Vector3d place = at(out, here + change, way[i].z());
                if (!fitsBetween(i, place)) continue;
                way[i] = place;
                break;
            }
        }
    }
}

std::vector<Eigen::Vector3d> ObjectMoves::straight(double from_m, double from_z, double to_m,
                                                   double to_z) const {
    for (int k = 0; k < kDirections; ++k) {
        const int side = k % 2 == 0 ? k / 2 : -(k + 1) / 2;
        const Eigen::Vector3d out = horizontal(angleOf(front_) + kFullCircle * side / kDirections);
        const Eigen::Vector3d from = at(out, from_m, from_z);
        const Eigen::Vector3d to = at(out, to_m, to_z);
        if (!scene_.sphere->fits(from) || !scene_.sphere->fits(to)) continue;
        if (scene_.sphere->segment(from, to).free && isSeen(from) && isSeen(to)) return {from, to};
    }
    return {};
}

Eigen::Vector3d ObjectMoves::at(const Eigen::Vector3d& out, double distance_m, double z) const {
    Eigen::Vector3d place = subject_.center + distance_m * out;
    place.z() = z;
    return scene_.sphere->inBand(place);
}

std::optional<Eigen::Vector3d> ObjectMoves::placeAt(const Eigen::Vector3d& out, double radius_m,
                                                    double z) const {
    for (const double factor : kDistanceFactors) {
        const Eigen::Vector3d place = at(out, factor * radius_m, z);
        if (scene_.sphere->fits(place) && isSeen(place)) return place;
    }
    return std::nullopt;
}

bool ObjectMoves::isSeen(const Eigen::Vector3d& place) const {
    const RayHit hit = scene_.rays->cast(place, subject_.center - place, 1.0);
    if (hit.object_id == 0 || hit.object_id == object_id_) return true;
    return object_id_ == 0 && !scene_.scene->object(hit.object_id).structure;
}

}  // namespace dollytrack::planning
