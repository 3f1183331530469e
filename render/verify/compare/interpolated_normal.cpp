#include "render/verify/compare/interpolated_normal.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dollytrack::verify {

Eigen::Vector3d interpolatedNormal(const Scene& scene, const RayHit& hit,
                                   const Eigen::Vector3d& place, const Eigen::Vector3d& along) {
    const Triangle& corners = scene.triangles[hit.triangle];
    const Eigen::Vector3d a = scene.positions[corners[0]].cast<double>();
    const Eigen::Vector3d ab = scene.positions[corners[1]].cast<double>() - a;
    const Eigen::Vector3d ac = scene.positions[corners[2]].cast<double>() - a;
    const Eigen::Vector3d face = ab.cross(ac);
    const double area = face.squaredNorm();
    if (area <= 0.0) return Eigen::Vector3d::Zero();
    const double b = (place - a).cross(ac).dot(face) / area;
    const double c = ab.cross(place - a).dot(face) / area;
    Eigen::Vector3d normal = ((1.0 - b - c) * scene.normals[corners[0]].cast<double>() +
                              b * scene.normals[corners[1]].cast<double>() +
                              c * scene.normals[corners[2]].cast<double>())
                                 .normalized();
    if (normal.dot(face) * along.dot(face) > 0.0) normal = -normal;
    return (normal - std::max(normal.dot(along), 0.0) * along).normalized();
}

}  // namespace dollytrack::verify
