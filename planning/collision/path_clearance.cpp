#include "planning/collision/path_clearance.h"

#include "engine/geometry/ray_caster.h"
#include "engine/plan/frame_series.h"

#include <algorithm>
#include <limits>

namespace dollytrack::planning {
namespace {

// Longest step along a motion, so that the minimum clearance is found, and shortest step, so that
// it gets past a contact.
constexpr double kLongestStep = 0.02;
constexpr double kShortestStep = 0.0005;
// Clearance beyond which a step may be as long as the free distance.
constexpr double kFar = 10.0;

}  // namespace

double smallestClearance(const RayCaster& rays, const std::vector<Eigen::Vector3d>& way,
                         double radius, const JobContext& job) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        const Eigen::Vector3d move = way[i + 1] - way[i];
        const double length = move.norm();
        double walked = 0.0;
        while (!job.cancelled()) {
            const double share = length > 0.0 ? walked / length : 0.0;
            const double distance = clearanceAt(rays, way[i] + share * move);
            smallest = std::min(smallest, distance);
            if (walked >= length) break;
            const double step = distance < radius ? kLongestStep : distance - radius;
            const double longest = std::max(kLongestStep, distance - kFar);
            walked = std::min(length, walked + std::clamp(step, kShortestStep, longest));
        }
    }
    return smallest;
}

}  // namespace dollytrack::planning
