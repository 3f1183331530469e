#include "engine/scene/object.h"

#include <cmath>

namespace dollytrack {

Eigen::Vector3d OrientedBox::toBox(const Eigen::Vector3d& in_world) const {
    return Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()) * (in_world - center);
}

Eigen::Vector3d OrientedBox::toWorld(const Eigen::Vector3d& in_box) const {
    return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * in_box + center;
}

std::array<Eigen::Vector3d, 8> OrientedBox::corners() const {
    std::array<Eigen::Vector3d, 8> result;
    for (unsigned i = 0; i < 8; ++i) {
        const Eigen::Vector3d sign((i & 1U) ? 1.0 : -1.0, (i & 2U) ? 1.0 : -1.0,
                                   (i & 4U) ? 1.0 : -1.0);
        result[i] = toWorld(sign.cwiseProduct(half_size));
    }
    return result;
}

bool OrientedBox::contains(const Eigen::Vector3d& in_world, double margin_m) const {
    return (toBox(in_world).cwiseAbs().array() <= half_size.array() + margin_m).all();
}

double OrientedBox::distance(const Eigen::Vector3d& in_world) const {
    return (toBox(in_world).cwiseAbs() - half_size).cwiseMax(0.0).norm();
}

}  // namespace dollytrack
