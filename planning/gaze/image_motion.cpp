#include "planning/gaze/image_motion.h"

#include "engine/jobs/parallel.h"
#include "engine/math/quantile.h"
#include "planning/timing/turn.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <array>
#include <vector>

namespace dollytrack::planning {
namespace {

constexpr int kParts = 3;              // of the path between two keys, each sampled at its middle
constexpr int kAcross = 4, kDown = 3;  // grid of rays over the image
constexpr double kFarthest_m = 20.0;

/// Median distance to the surfaces in a view, m; surfaces farther than 20 m count as 20 m.
double medianDepth(const Pose& pose, const ViewEstimator& views) {
    std::vector<RayCaster::BundleRay> rays;
    for (int y = 0; y < kDown; ++y) {
        for (int x = 0; x < kAcross; ++x) {
            const Intrinsics& lens = views.intrinsics();
            rays.push_back({pose.rotation * lens.unproject(lens.width * (x + 0.5) / kAcross,
                                                           lens.height * (y + 0.5) / kDown)});
        }
    }
    std::vector<RayHit> hits;
    views.rays().castBundle(pose.position, rays, views.nearDistance(), hits);
    std::vector<double> depths;
    for (const RayHit& hit : hits) {
        depths.push_back(hit.object_id == 0 ? kFarthest_m : std::min(hit.distance, kFarthest_m));
    }
    return std::max(upperMedian(std::move(depths)), views.nearDistance());
}

}  // namespace

void measureImageMotion(SmoothPath& path,
                        const std::function<Pose(const SmoothPath::Key&)>& pose_at,
                        const ViewEstimator& views, const PitchBand& pitch) {
    if (path.keys.size() < 2) return;
    parallelFor(path.keys.size() - 1, [&](std::size_t k) {
        const SmoothPath::Key& from = path.keys[k];
        SmoothPath::Key& to = path.keys[k + 1];
        const Turn turn(pose_at(from).rotation, pose_at(to).rotation, pitch);
        const double length = to.arc_m - from.arc_m;
        double motion = turn.angle();
        for (int part = 0; part < kParts && length > 0.0; ++part) {
            const auto at = [&](double share) { return path.at(from.arc_m + share * length); };
            const double middle = (part + 0.5) / kParts;
            const Pose pose{at(middle), turn.at(middle * turn.angle())};
            const Eigen::Vector3d way =
                at((part + 1.0) / kParts) - at(static_cast<double>(part) / kParts);
            const Eigen::Vector3d forward = pose.forward();
            // Moving towards a surface moves its image about half as fast as moving past it.
            const double across =
                (way - way.dot(forward) * forward).norm() + 0.5 * std::abs(way.dot(forward));
            motion += across / medianDepth(pose, views);
        }
        to.image_motion_rad = motion;
    });
}

}  // namespace dollytrack::planning
