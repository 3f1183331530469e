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
    std::vector<Eigen::Vector3d> longest;
    std::vector<Eigen::Vector3d> run;
    // A full circle may start anywhere: a second round finds what crosses its start.
    const int rounds = arc_rad >= kFullCircle - 1e-9 ? 2 : 1;
    for (int k = 0; k <= rounds * steps; ++k) {
        job.report(static_cast<double>(k) / (rounds * steps));
        if (job.cancelled()) return {};
        const double angle = angleOf(front_) + arc * (static_cast<double>(k) / steps - 0.5);
        const auto place = placeAt(horizontal(angle), radius_m, z);
        const bool goes_on =
            place && (run.empty() || scene_.sphere->segment(run.back(), *place).free);
        if (!goes_on) run.clear();
        if (place) run.push_back(*place);
        if (run.size() > longest.size()) longest = run;
        if (longest.size() > static_cast<std::size_t>(steps)) break;
    }
    const double found = arc * (static_cast<double>(longest.size()) - 1.0) / steps;
    if (found < std::min(kShortestArc, arc) - 1e-9) return {};
    return {std::move(longest), found / arc};
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
