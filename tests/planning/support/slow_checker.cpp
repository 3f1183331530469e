#include "tests/planning/support/slow_checker.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dollytrack::planning::test_support {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Traits =
    CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>>;

constexpr double kStep = 0.002;     // m
constexpr double kRounding = 2e-5;  // m; the planner's distances are floats

Kernel::Point_3 pointOf(const Eigen::Vector3d& p) {
    return {p.x(), p.y(), p.z()};
}

/// A point of the curve by de Casteljau's algorithm.
Eigen::Vector3d onCurve(const SmoothPath::Piece& piece, double t) {
    const Eigen::Vector3d a = (1 - t) * piece.start + t * piece.control;
    const Eigen::Vector3d b = (1 - t) * piece.control + t * piece.end;
    return (1 - t) * a + t * b;
}

/// Goes from frame to frame along the path, displaced by the sway, which is interpolated: evenly
/// from curve to curve, and within each by the curve's own parameter.
template <class Look>
void walkBeside(const SmoothPath& path, const TrajectoryFrame& from, const TrajectoryFrame& to,
                const Look& look) {
    const Eigen::Vector3d aside = from.pose.position - path.at(from.arc_m);
    const Eigen::Vector3d change = to.pose.position - path.at(to.arc_m) - aside;
    for (const SmoothPath::Piece& piece : path.pieces) {
        const double begin = std::max(from.arc_m, piece.begin_m);
        const double end = std::min(to.arc_m, piece.begin_m + piece.length_m);
        if (end <= begin) continue;
        const double first = piece.parameterAt(begin - piece.begin_m);
        const double last = piece.parameterAt(end - piece.begin_m);
        const double whole = to.arc_m - from.arc_m;
        const int steps = static_cast<int>((end - begin + change.norm()) / kStep) + 1;
        for (int i = 0; i <= steps; ++i) {
            const double share = static_cast<double>(i) / steps;
            const double arc = begin + share * (end - begin) - from.arc_m;
            look(onCurve(piece, first + share * (last - first)) + aside + arc / whole * change);
        }
    }
}

}  // namespace

struct SlowChecker::Impl {
    Triangles triangles;
    CGAL::AABB_tree<Traits> tree;
};

SlowChecker::SlowChecker(const Scene& scene) : impl_(std::make_unique<Impl>()) {
    for (const Triangle& corners : scene.triangles) {
        const auto at = [&](unsigned k) {
            return pointOf(scene.positions[corners[k]].cast<double>());
        };
        const Kernel::Triangle_3 triangle(at(0), at(1), at(2));
        // CGAL has no distance to a triangle without area; its sides usually belong to other
        // triangles, too.
        if (!triangle.is_degenerate()) impl_->triangles.push_back(triangle);
    }
    impl_->tree.insert(impl_->triangles.begin(), impl_->triangles.end());
    impl_->tree.accelerate_distance_queries();
}
SlowChecker::~SlowChecker() = default;

double SlowChecker::distance(const Eigen::Vector3d& position) const {
    return std::sqrt(impl_->tree.squared_distance(pointOf(position)));
}

SlowChecker::Found SlowChecker::check(const Plan& plan, double radius_m, bool shaken) const {
    Found found;
    found.clearance_m = std::numeric_limits<double>::infinity();
    const auto look = [&](const Eigen::Vector3d& position) {
        const double here = distance(position);
        ++found.places;
        found.touching += here < radius_m - kRounding ? 1 : 0;
        if (here >= found.clearance_m) return;
        found.clearance_m = here;
        found.position = position;
    };
    for (const SmoothPath& path : plan.smooth_paths) {
        for (const SmoothPath::Piece& piece : path.pieces) {
            const double most =
                (piece.control - piece.start).norm() + (piece.end - piece.control).norm();
            const int steps = static_cast<int>(most / kStep) + 1;
            for (int i = 0; i <= steps; ++i) look(onCurve(piece, static_cast<double>(i) / steps));
        }
    }
    const std::vector<TrajectoryFrame> frames = motionFrames(plan.trajectory);
    for (const TrajectoryFrame& frame : frames) look(frame.pose.position);
    for (std::size_t i = 1; shaken && i < frames.size(); ++i) {
        if (frames[i].path != frames[i - 1].path) continue;
        const std::size_t path = frames[i].path;
        walkBeside(plan.smooth_paths[path], frames[i - 1], frames[i], look);
    }
    return found;
}

}  // namespace dollytrack::planning::test_support
