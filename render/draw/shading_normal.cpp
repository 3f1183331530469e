#include "render/draw/shading_normal.h"

#include <algorithm>

namespace dollytrack::render {

Eigen::Vector3d shadingNormal(const Scene& scene, const std::vector<Eigen::Isometry3d>& to_rest,
                              const RayHit& hit, const Eigen::Vector3d& origin,
                              const Eigen::Vector3d& direction) {
    Eigen::Isometry3d rest_from_now = Eigen::Isometry3d::Identity();
    if (!to_rest.empty()) rest_from_now = to_rest[hit.object_id];
    const Eigen::Vector3d point = rest_from_now * (origin + hit.distance * direction);
    const Eigen::Vector3d along = (rest_from_now.linear() * direction).normalized();

    const Triangle& corners = scene.triangles[hit.triangle];
    const Eigen::Vector3d a = scene.positions[corners[0]].cast<double>();
    const Eigen::Vector3d ab = scene.positions[corners[1]].cast<double>() - a;
    const Eigen::Vector3d ac = scene.positions[corners[2]].cast<double>() - a;
    const Eigen::Vector3d across = ab.cross(ac);
    const Eigen::Vector3d face = across.dot(along) > 0.0 ? -across : across;
    const double v = (point - a).cross(ac).dot(across) / across.squaredNorm();
    const double w = ab.cross(point - a).dot(across) / across.squaredNorm();
    Eigen::Vector3d normal = (1.0 - v - w) * scene.normals[corners[0]].cast<double>() +
                             v * scene.normals[corners[1]].cast<double>() +
                             w * scene.normals[corners[2]].cast<double>();
    if (!(normal.norm() > 1e-6)) normal = face;
    normal.normalize();
    if (normal.dot(face) < 0.0) normal = -normal;
    // Near an outline a smoothed normal may point away from the viewer; it is projected onto the
    // outline.
    normal -= std::max(normal.dot(along), 0.0) * along;
    return (rest_from_now.linear().transpose() * normal).normalized();
}

}  // namespace dollytrack::render
