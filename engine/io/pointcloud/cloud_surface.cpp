#include "engine/io/pointcloud/cloud_surface.h"

#include "engine/core/random.h"
#include "engine/io/pointcloud/hole_filler.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>

#include <algorithm>
#include <array>

namespace dollytrack::io {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Stopped {};

/// What the front advances by: the smallest sphere first, and never over a long edge.
struct ShortEdges {
    double longest2 = 0.0;
    const JobContext* job = nullptr;

    template <class Front, class Cell>
    double operator()(const Front& front, const Cell& cell, int opposite) const {
        if (job->cancelled()) throw Stopped();
        for (int i = 1; i <= 3; ++i) {
            const auto& a = cell->vertex((opposite + i) & 3)->point();
            const auto& b = cell->vertex((opposite + i % 3 + 1) & 3)->point();
            if (CGAL::squared_distance(a, b) > longest2) return front.infinity();
        }
        return front.smallest_radius_delaunay_sphere(cell, opposite);
    }
};

/// Turned so that it faces where its corners' normals point.
void face(const CloudSamples& samples, Triangle& t) {
    const Eigen::Vector3d& a = samples.points[t[0]];
    const Eigen::Vector3d normal = (samples.points[t[1]] - a).cross(samples.points[t[2]] - a);
    const Eigen::Vector3d wanted =
        samples.normals[t[0]] + samples.normals[t[1]] + samples.normals[t[2]];
    if (normal.dot(wanted) < 0.0) std::swap(t[1], t[2]);
}

}  // namespace

Result<CloudSurface> meshCloud(const CloudSamples& samples, const CloudParams& params,
                               const JobContext& job) {
    CloudSurface surface;
    if (samples.points.size() < 3) return surface;
    std::vector<Kernel::Point_3> points;
    points.reserve(samples.points.size());
    // All in one plane, or many on one sphere, leave the tetrahedra open: nothing is moved visibly.
    Random random(1);
    const double off = 1e-4 * samples.voxel_m;
    for (const Eigen::Vector3d& p : samples.points) {
        const double x = p.x() + random.uniform(-off, off);
        const double y = p.y() + random.uniform(-off, off);
        points.emplace_back(x, y, p.z() + random.uniform(-off, off));
    }
    std::vector<std::array<std::size_t, 3>> faces;
    const double longest = std::max(params.gap_m, 5.0 * samples.voxel_m);
    CGAL::get_default_random() = CGAL::Random(0);  // what ran before must not count
    try {
        CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                                     std::back_inserter(faces),
                                                     ShortEdges{longest * longest, &job});
    } catch (const Stopped&) {
        return fail(ErrorCode::Cancelled, "import was cancelled");
    }
    job.report(0.8);
    for (const auto& f : faces) {
        Triangle t = {static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]),
                      static_cast<std::uint32_t>(f[2])};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        surface.triangles.push_back(t);
    }
    // CGAL lists them as they lie in memory.
    std::sort(surface.triangles.begin(), surface.triangles.end());
    const std::vector<Triangle> filling =
        fillHoles(samples.points, surface.triangles, params.hole_m, surface.holes_filled);
    surface.hole_triangles = filling.size();
    surface.triangles.insert(surface.triangles.end(), filling.begin(), filling.end());
    for (Triangle& t : surface.triangles) face(samples, t);
    job.report(1.0);
    return surface;
}

}  // namespace dollytrack::io
