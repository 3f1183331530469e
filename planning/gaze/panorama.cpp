#include "planning/gaze/panorama.h"

#include "engine/core/random.h"
#include "engine/plan/capture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kSilhouetteOfBox = 0.6;       // share of its box's silhouette that an object fills
constexpr double kReachedBefore = 1.0 - 1e-3;  // a ray that reaches the sample was not blocked
constexpr double kLeastShown = 1.0 / 3.0;      // least share of a target in the image; less is only
                                               // a fragment at the border
// Sizes in a 640 x 480 image: the least that counts as seen, and one beyond which more adds
// nothing.
constexpr double kLeastPixels = 120.0;
constexpr double kPlentyPixels = 3000.0;

/// Stratified samples of an object's surface, uniform by area. The same at every call, and for
/// either winding of the triangles.
std::array<Eigen::Vector3d, TargetSamples::kPerObject> spread(const Scene& scene,
                                                              const Object& object) {
    std::vector<double> until;  // cumulated area of the triangles
    double area = 0.0;
    const auto cornersOf = [&](std::uint32_t t) {
        std::array<Eigen::Vector3d, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] =
                scene.positions[scene.triangles[object.first_triangle + t][k]].cast<double>();
        }
        std::ranges::sort(corners, [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
            return std::ranges::lexicographical_compare(a, b);
        });
        return corners;
    };
    for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
        const auto [a, b, c] = cornersOf(t);
        area += 0.5 * (b - a).cross(c - a).norm();
        until.push_back(area);
    }
    std::array<Eigen::Vector3d, TargetSamples::kPerObject> points;
    Random random(0, static_cast<std::uint64_t>(object.id));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double wanted =
            area * (static_cast<double>(i) + random.uniform()) / static_cast<double>(points.size());
        const auto found = std::lower_bound(until.begin(), until.end(), wanted);
        const auto t = static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(
            found - until.begin(), static_cast<std::ptrdiff_t>(until.size()) - 1));
        const double u = std::sqrt(random.uniform());
        const double v = random.uniform();
        const auto [a, b, c] = cornersOf(t);
        points[i] = (1.0 - u) * a + u * (1.0 - v) * b + u * v * c;
    }
    return points;
}

/// Projected area of a box along a unit direction, m2.
double silhouette(const OrientedBox& box, const Eigen::Vector3d& direction) {
    const double c = std::cos(box.yaw);
    const double s = std::sin(box.yaw);
    const Eigen::Vector3d size = 2.0 * box.half_size;
    return std::abs(direction.x() * c + direction.y() * s) * size.y() * size.z() +
           std::abs(direction.y() * c - direction.x() * s) * size.x() * size.z() +
           std::abs(direction.z()) * size.x() * size.y();
}

}  // namespace

TargetSamples::TargetSamples(const ViewEstimator& views) {
    for (const Object& object : views.scene().objects) {
        if (object.role != Role::Target || object.triangle_count == 0) continue;
        targets_.push_back({object.id, spread(views.scene(), object)});
    }
}

Panorama::Panorama(const ViewEstimator& views, const TargetSamples& samples,
                   const Eigen::Vector3d& place) {
    const Intrinsics& lens = views.intrinsics();
    half_size_ = {lens.cx / lens.fx, lens.cy / lens.fy};
    // Pixels scaled to a 640 x 480 image, as in ViewEstimator.
    const double pixels_at_1m = lens.fx * lens.fy * 640.0 * 480.0 / (lens.width * lens.height);
    std::vector<RayCaster::BundleRay> rays;
    std::vector<std::size_t> of_target;
    const auto& targets = samples.targets();
    for (std::size_t t = 0; t < targets.size(); ++t) {
        const OrientedBox& box = views.scene().object(targets[t].object_id).box;
        const double distance2 = std::max(1e-4, (box.center - place).squaredNorm());
        if (silhouette(box, (box.center - place) / std::sqrt(distance2)) * pixels_at_1m <
            kLeastPixels * distance2) {
            continue;  // too far away to be seen
        }
        of_target.push_back(t);
        for (const Eigen::Vector3d& point : targets[t].points) {
            rays.push_back({point - place, 1.001F});
        }
    }
    thread_local std::vector<RayHit> hits;
    views.rays().castBundle(place, rays, 0.0, hits);
    for (std::size_t i = 0; i < of_target.size(); ++i) {
        const TargetSamples::Target& target = targets[of_target[i]];
        VisibleTarget seen{of_target[i], 0.0, {}};
        for (std::size_t k = 0; k < TargetSamples::kPerObject; ++k) {
            const std::size_t ray = i * TargetSamples::kPerObject + k;
            // A sample hidden only by its own object counts: that part of the silhouette is
            // visible.
            if (hits[ray].object_id == target.object_id || hits[ray].distance >= kReachedBefore ||
                hits[ray].object_id == 0) {
                seen.visible.push_back(rays[ray].direction);
            }
        }
        if (seen.visible.empty()) continue;
        const OrientedBox& box = views.scene().object(target.object_id).box;
        const Eigen::Vector3d towards = box.center - place;
        const double distance2 = std::max(1e-2, towards.squaredNorm());
        seen.pixels =
            kSilhouetteOfBox * silhouette(box, towards.normalized()) * pixels_at_1m / distance2;
        boundDirections(seen);
        visible_targets_.push_back(std::move(seen));
    }
}

void Panorama::boundDirections(VisibleTarget& seen) const {
    seen.axis = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& way : seen.visible) seen.axis += way.normalized();
    seen.axis.normalize();
    double radius = 0.0;
    for (const Eigen::Vector3d& way : seen.visible) {
        radius = std::max(radius, angleBetween(seen.axis, way));
    }
    const double farthest = std::atan(half_size_.norm()) + radius;
    if (farthest < std::numbers::pi) seen.least_cosine = std::cos(farthest) - 1e-9;
}

double Panorama::shownShare(const Eigen::Matrix3d& camera_from_world,
                            const VisibleTarget& seen) const {
    int inside = 0;
    for (const Eigen::Vector3d& direction : seen.visible) {
        const Eigen::Vector3d p = camera_from_world * direction;
        if (p.z() > 0.0 && std::abs(p.x()) < half_size_.x() * p.z() &&
            std::abs(p.y()) < half_size_.y() * p.z()) {
            ++inside;
        }
    }
    const double shown = static_cast<double>(inside) / TargetSamples::kPerObject;
    if (shown < kLeastShown) return 0.0;
    const double pixels = shown * seen.pixels;
    return std::clamp(std::log(pixels / kLeastPixels) / std::log(kPlentyPixels / kLeastPixels), 0.0,
                      1.0);
}

}  // namespace dollytrack::planning
