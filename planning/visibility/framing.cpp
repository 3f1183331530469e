#include "planning/visibility/framing.h"

#include <algorithm>
#include <limits>

namespace dollytrack::planning {
namespace {

/// Sizes of the subject seen from a direction, m: width, height, and depth from the centre towards
/// the camera.
struct Sizes {
    double width = 0.0;
    double height = 0.0;
    double half_depth = 0.0;
};

Sizes sizesFrom(const Subject& subject, const Eigen::Vector3d& direction) {
    const Eigen::Matrix3d axes = lookAlong(-direction).toRotationMatrix();
    Sizes sizes;
    for (const Eigen::Vector3d& point : subject.points) {
        const Eigen::Vector3d p = axes.transpose() * (point - subject.center);
        // Symmetric about the centre, since the camera looks at the centre.
        sizes.width = std::max(sizes.width, 2.0 * std::abs(p.x()));
        sizes.height = std::max(sizes.height, 2.0 * std::abs(p.y()));
        sizes.half_depth = std::max(sizes.half_depth, -p.z());
    }
    return sizes;
}

}  // namespace

Subject makeSubject(const ViewEstimator& views, const std::vector<int>& objects) {
    Subject subject;
    Eigen::AlignedBox3d box;
    for (const int id : objects) {
        for (const Eigen::Vector3d& point : views.extremes(id)) {
            subject.points.push_back(point);
            box.extend(point);
        }
    }
    subject.center =
        objects.size() == 1 ? views.scene().object(objects.front()).box.center : box.center();
    return subject;
}

double fillFrom(const ViewEstimator& views, const Subject& subject,
                const Eigen::Vector3d& position) {
    const Pose pose = lookAt(position, subject.center);
    const Eigen::Matrix3d camera_from_world = pose.rotation.toRotationMatrix().transpose();
    const Intrinsics& k = views.intrinsics();
    double fill = 0.0;
    for (const Eigen::Vector3d& point : subject.points) {
        const Eigen::Vector3d p = camera_from_world * (point - position);
        if (p.z() < views.nearDistance()) return std::numeric_limits<double>::infinity();
        fill = std::max({fill, 2.0 * k.fx * std::abs(p.x()) / (p.z() * k.width),
                         2.0 * k.fy * std::abs(p.y()) / (p.z() * k.height)});
    }
    return fill;
}

double distanceForFill(const ViewEstimator& views, const Subject& subject,
                       const Eigen::Vector3d& direction, double fill) {
    const Sizes sizes = sizesFrom(subject, direction);
    const Intrinsics& k = views.intrinsics();
    double beyond =
        std::max(sizes.width * k.fx / (fill * k.width), sizes.height * k.fy / (fill * k.height));
    // The formula puts the whole outline on the face nearest to the camera. Most outlines lie
    // farther back and appear smaller, so move closer by the share that the points really take.
    for (int i = 0; i < 2; ++i) {
        const double reached =
            fillFrom(views, subject, subject.center + direction * (sizes.half_depth + beyond));
        if (reached > 0.0 && reached < fill) beyond *= std::max(0.5, reached / fill);
    }
    return sizes.half_depth + beyond;
}

double slenderness(const ViewEstimator& views, const Subject& subject,
                   const Eigen::Vector3d& direction) {
    const Sizes sizes = sizesFrom(subject, direction);
    const Intrinsics& k = views.intrinsics();
    const double w = sizes.width / k.width;
    const double h = sizes.height / k.height;
    return std::min(w, h) / std::max({w, h, 1e-9});
}

}  // namespace dollytrack::planning
