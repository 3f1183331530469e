#include "planning/visibility/heading_limit.h"

#include "engine/math/angle.h"
#include "planning/plan_params.h"

#include <cmath>

namespace dollytrack::planning {

double angleFromAbove(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.head<2>().dot(b.head<2>())));
}

bool isUpright(const Eigen::Vector3d& direction) {
    constexpr double kLevelShare = 0.05;
    return direction.head<2>().norm() <= kLevelShare * direction.norm();
}

bool HeadingLimit::allows(const Eigen::Vector3d& view, const Eigen::Vector3d& motion) const {
    return !restricts() || isUpright(motion) ||
           (!isUpright(view) && angleFromAbove(view, motion) <= angle);
}

HeadingLimit headingLimit(const BodyParams& params) {
    HeadingLimit limit;
    if (params.heading == Heading::Along) limit.angle = params.max_heading_deg * kDegree;
    return limit;
}

}  // namespace dollytrack::planning
