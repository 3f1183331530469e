#include "planning/targets/supports.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/plan_params.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace dollytrack::planning {
namespace {

// Contact tolerance, m: objects are modelled to touch within this; more is a visible gap.
constexpr double kTouch = 0.06;

// Surfaces closer than this coincide for a ray, which may hit either first.
constexpr double kShared = 1e-4;

/// Another object with a surface where the ray leaves this one, as a wall behind a picture; or 0.
int sharesSurface(const Scene& scene, const RayCaster& rays, int self,
                  const Eigen::Vector3d& on_surface, const Eigen::Vector3d& direction) {
    const Eigen::Vector3d before = on_surface - kShared * direction;
    for (const Object& other : scene.objects) {
        if (other.id == self || other.box.distance(on_surface) > kShared) continue;
        if (rays.meetsObject(other.id, before, direction, 2.0 * kShared)) return other.id;
    }
    return 0;
}

struct Contact {
    int object_id = 0;
    double distance = 0.0;
};

/// First hit that is not on the object itself.
std::optional<Contact> castPast(const Scene& scene, const RayCaster& rays, int self,
                                const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                double reach, double begin = 0.0) {
    std::optional<double> left;  // where the ray last met the object itself
    for (int i = 0; i < 16; ++i) {
        const RayHit hit = rays.cast(origin, direction, reach, begin);
        if (hit.object_id == 0) break;
        if (hit.object_id != self) return Contact{hit.object_id, hit.distance};
        left = hit.distance;
        begin = hit.distance + kShared;
    }
    if (!left) return std::nullopt;
    const int other = sharesSurface(scene, rays, self, origin + *left * direction, direction);
    return other == 0 ? std::nullopt : std::optional(Contact{other, *left});
}

/// The object hit by most of five rays down from the underside; or 0.
int restsOn(const Scene& scene, const RayCaster& rays, const Object& object) {
    std::map<int, int> votes;
    for (const auto& [x, y] :
         {std::pair{0.0, 0.0}, {0.6, 0.6}, {-0.6, 0.6}, {0.6, -0.6}, {-0.6, -0.6}}) {
        Eigen::Vector3d origin =
            object.box.toWorld({x * object.box.half_size.x(), y * object.box.half_size.y(), 0.0});
        const double bottom = object.box.center.z() - object.box.half_size.z();
        origin.z() = bottom + 0.5 * std::min(kTouch, object.box.half_size.z());
        const auto hit = castPast(scene, rays, object.id, origin, -Eigen::Vector3d::UnitZ(),
                                  origin.z() - bottom + kTouch);
        if (hit) ++votes[hit->object_id];
    }
    int best = 0;
    int most = 0;
    for (const auto& [id, count] : votes) {
        if (count <= most) continue;
        most = count;
        best = id;
    }
    return best;
}

/// Whether the supporter also covers the object from above, as the next board of a shelf does.
bool isCovered(const Scene& scene, const RayCaster& rays, const Object& object,
               const Object& supporter) {
    const double top = supporter.box.center.z() + supporter.box.half_size.z();
    if (object.centroid.z() >= top) return false;
    const auto hit = castPast(scene, rays, object.id, object.box.center, Eigen::Vector3d::UnitZ(),
                              top - object.box.center.z() + kTouch);
    return hit && hit->object_id == supporter.id;
}

/// The horizontal direction with the longest free view out of the supporter.
Eigen::Vector3d openSide(const Scene& scene, const RayCaster& rays, const Object& object,
                         const Object& supporter) {
    double longest = -1.0;
    Eigen::Vector3d best = supporter.front;
    for (int i = 0; i < 4; ++i) {
        const double angle = supporter.box.yaw + i * 0.5 * std::numbers::pi;
        const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
        const auto hit = castPast(scene, rays, object.id, object.box.center, direction, 10.0);
        const double reach = (hit ? hit->distance : 10.0) + 0.2 * direction.dot(supporter.front);
        if (reach <= longest) continue;
        longest = reach;
        best = direction;
    }
    return best;
}

/// The nearest object beside this one within the tolerance, and the direction away from it.
std::optional<std::pair<int, Eigen::Vector3d>> hangsAt(const Scene& scene, const RayCaster& rays,
                                                       const Object& object) {
    std::optional<std::pair<int, Eigen::Vector3d>> best;
    double nearest = kTouch;
    for (int i = 0; i < 4; ++i) {
        const double angle = object.box.yaw + i * 0.5 * std::numbers::pi;
        const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
        const double half = object.box.half_size[i % 2];
        // Only surfaces near the object's side count: an object inside its box, as in a cupboard,
        // does not hold it.
        const auto hit = castPast(scene, rays, object.id, object.box.center, direction,
                                  half + kTouch, std::max(0.0, half - kTouch));
        if (!hit || hit->distance - half >= nearest) continue;
        nearest = hit->distance - half;
        best = {hit->object_id, -direction};
    }
    return best;
}

/// The object just above this one's top, as the ceiling above a lamp's cord; or 0.
int hangsFrom(const Scene& scene, const RayCaster& rays, const Object& object) {
    Eigen::Vector3d origin = object.box.center;
    const double half = object.box.half_size.z();
    origin.z() += std::max(0.0, half - kTouch);
    const auto hit = castPast(scene, rays, object.id, origin, Eigen::Vector3d::UnitZ(),
                              std::min(half, kTouch) + kTouch);
    return hit ? hit->object_id : 0;
}

SupportRelation findSupport(const Scene& scene, const RayCaster& rays, const TargetParams& params,
                            const Object& object) {
    SupportRelation support;
    support.small =
        object.size_given ? !object.large : object.box.volume() < params.small_volume_m3;
    if (const int below = restsOn(scene, rays, object); below != 0) {
        support.holder = below;
        const Object& supporter = scene.object(below);
        if (supporter.structure) return support;  // stands on the floor
        const bool much_smaller =
            !object.size_given && supporter.box.volume() > params.size_ratio * object.box.volume();
        if (!support.small && !much_smaller) return support;
        support.small = true;
        support.supporter = below;
        support.kind =
            isCovered(scene, rays, object, supporter) ? TargetKind::Shelf : TargetKind::Support;
        if (support.kind == TargetKind::Shelf)
            support.outward = openSide(scene, rays, object, supporter);
        return support;
    }
    const auto side = hangsAt(scene, rays, object);
    support.holder = side ? side->first : hangsFrom(scene, rays, object);
    support.hangs = support.holder != 0;
    if (side && support.small) {
        support.kind = TargetKind::Suspension;
        support.supporter = side->first;
        support.outward = side->second;
    }
    return support;
}

}  // namespace

std::vector<SupportRelation> findSupports(const Scene& scene, const RayCaster& rays,
                                          const TargetParams& params) {
    std::vector<SupportRelation> supports(scene.objects.size());
    parallelFor(scene.objects.size(), [&](std::size_t i) {
        if (scene.objects[i].role != Role::Target) return;
        supports[i] = findSupport(scene, rays, params, scene.objects[i]);
    });
    return supports;
}

}  // namespace dollytrack::planning
