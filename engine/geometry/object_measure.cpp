#include "engine/geometry/object_measure.h"

#include "engine/geometry/oriented_box.h"

#include <span>

namespace dollytrack {

void measureObject(const Scene& scene, Object& object) {
    const std::span<const Eigen::Vector3f> points(scene.positions.data() + object.first_vertex,
                                                  object.vertex_count);
    object.box = fitUprightBox(points);
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double area = 0.0;
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const Triangle& t = scene.triangles[object.first_triangle + i];
        const Eigen::Vector3d a = scene.positions[t[0]].cast<double>();
        const Eigen::Vector3d b = scene.positions[t[1]].cast<double>();
        const Eigen::Vector3d c = scene.positions[t[2]].cast<double>();
        const double weight = (b - a).cross(c - a).norm();
        moment += weight * (a + b + c) / 3.0;
        area += weight;
    }
    object.centroid = area > 0.0 ? Eigen::Vector3d(moment / area) : object.box.center;
}

}  // namespace dollytrack
