#include "planning/coverage/surface_patches.h"

#include "engine/camera/intrinsics.h"
#include "engine/geometry/ray_caster.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kMostPatches = 6000;
constexpr double kLeastPixels = 8.0;

using Corners = std::array<Eigen::Vector3d, 3>;

/// Visits points of the triangle near the box, at most half the spacing apart: subdivides it and
/// drops pieces outside the box, so that the cost of a huge ground plane depends on the box alone.
template <class Visit>
void samplePoints(const Corners& corner, const Eigen::AlignedBox3d& around, double spacing_m,
                  const Visit& visit) {
    Eigen::AlignedBox3d extent;
    for (const Eigen::Vector3d& one : corner) extent.extend(one);
    if (!around.intersects(extent)) return;
    if (extent.diagonal().norm() <= 0.5 * spacing_m) {
        visit((corner[0] + corner[1] + corner[2]) / 3.0);
        return;
    }
    const Corners middle = {0.5 * (corner[0] + corner[1]), 0.5 * (corner[1] + corner[2]),
                            0.5 * (corner[2] + corner[0])};
    samplePoints({corner[0], middle[0], middle[2]}, around, spacing_m, visit);
    samplePoints({middle[0], corner[1], middle[1]}, around, spacing_m, visit);
    samplePoints({middle[2], middle[1], corner[2]}, around, spacing_m, visit);
    samplePoints({middle[0], middle[1], middle[2]}, around, spacing_m, visit);
}

std::vector<SurfacePatch> samplePatches(const Scene& scene, const OrientedBox& box,
                                        double spacing_m) {
    Eigen::AlignedBox3d around;
    for (const Eigen::Vector3d& corner : box.corners()) around.extend(corner);
    std::vector<SurfacePatch> patches;
    std::set<std::array<int, 4>> taken;  // grid cell and dominant axis of the normal
    for (const Triangle& triangle : scene.triangles) {
        Corners corner;
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = scene.positions[triangle[i]].cast<double>();
        }
        const Eigen::Vector3d across = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
        if (!(across.norm() > 1e-12)) continue;
        const Eigen::Vector3d normal = across.normalized();
        Eigen::Index axis = 0;
        normal.cwiseAbs().maxCoeff(&axis);
        samplePoints(corner, around, spacing_m, [&](const Eigen::Vector3d& point) {
            if (!box.contains(point)) return;
            std::array<int, 4> key = {0, 0, 0, static_cast<int>(axis)};
            for (unsigned k = 0; k < 3; ++k) {
                key[k] = static_cast<int>(std::floor(point[k] / spacing_m));
            }
            if (taken.insert(key).second) patches.push_back({point, normal});
        });
    }
    return patches;
}

}  // namespace

SurfacePatches patchesIn(const Scene& scene, const OrientedBox& box, double spacing_m) {
    SurfacePatches found;
    found.spacing_m = spacing_m;
    // Large regions get larger patches.
    const double area =
        8.0 * (box.half_size.x() * box.half_size.y() + box.half_size.y() * box.half_size.z() +
               box.half_size.z() * box.half_size.x());
    const double most = static_cast<double>(kMostPatches);
    found.spacing_m = std::max(spacing_m, std::sqrt(area / most));
    found.patches = samplePatches(scene, box, found.spacing_m);
    while (found.patches.size() > kMostPatches) {
        found.spacing_m *= 1.4;
        found.patches = samplePatches(scene, box, found.spacing_m);
    }
    return found;
}

PatchVisibility::PatchVisibility(const RayCaster& rays, const VisibilityRules& rules)
    : rays_(rays), rules_(rules) {}

PatchVisibility::PatchVisibility(const RayCaster& rays, const Intrinsics& intrinsics,
                                 double spacing_m)
    : PatchVisibility(rays, {.farthest_m = spacing_m * intrinsics.fx / kLeastPixels}) {}

bool PatchVisibility::faces(const Eigen::Vector3d& from, const SurfacePatch& patch) const {
    const Eigen::Vector3d way = patch.point - from;
    const double distance = way.norm();
    if (distance > rules_.farthest_m || distance < 1e-6) return false;
    const double cosine = -(way / distance).dot(patch.normal);
    return (rules_.two_sided ? std::abs(cosine) : cosine) >= rules_.flattest_cosine;
}

bool PatchVisibility::reaches(const Eigen::Vector3d& from, const SurfacePatch& patch) const {
    if (!faces(from, patch)) return false;
    const Eigen::Vector3d way = patch.point - from;
    const double distance = way.norm();
    return rays_.cast(from, way / distance, distance - kReached_m).object_id == 0;
}

}  // namespace dollytrack::planning
