#include "engine/io/pointcloud/cloud_surface.h"

#include "engine/core/random.h"
#include "engine/io/pointcloud/hole_filler.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <utility>

namespace dollytrack {
namespace {

/// Lets CGAL order cells and vertices by their creation instead of their addresses.
template <class Base>
class Stamped : public Base {
  public:
    template <class Tds>
    struct Rebind_TDS {
        using Other = Stamped<typename Base::template Rebind_TDS<Tds>::Other>;
    };
    using Has_timestamp = CGAL::Tag_true;
    using Base::Base;
    [[nodiscard]] std::size_t time_stamp() const { return stamp_; }
    void set_time_stamp(std::size_t stamp) { stamp_ = stamp; }

  private:
    std::size_t stamp_ = static_cast<std::size_t>(-1);
};

/// A kernel type of this file, so that std::less can be specialized below for types based on it.
struct Kernel : CGAL::Exact_predicates_inexact_constructions_kernel {};
using Vertex = CGAL::Advancing_front_surface_reconstruction_vertex_base_3<
    Kernel, Stamped<CGAL::Triangulation_vertex_base_3<Kernel>>>;
using Cell = CGAL::Advancing_front_surface_reconstruction_cell_base_3<
    Kernel, Stamped<CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using Tetrahedra =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
using FrontCandidate = Tetrahedra::Vertex::Radius_ptr_type;

/// Numbers of the front's edges, in the order of their first use.
std::unordered_map<const void*, std::uint64_t>& edgeNumbers() {
    thread_local std::unordered_map<const void*, std::uint64_t> numbers;
    return numbers;
}

std::uint64_t numberOf(const void* edge) {
    auto& numbers = edgeNumbers();
    return numbers.try_emplace(edge, numbers.size()).first->second;
}

struct Stopped {};

/// Priority of the front's candidates: smallest circumscribed sphere first, never with a long edge.
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

/// Orients a triangle in the direction of its corners' normals.
void face(const CloudSamples& samples, Triangle& t) {
    const Eigen::Vector3d& a = samples.points[t[0]];
    const Eigen::Vector3d normal = (samples.points[t[1]] - a).cross(samples.points[t[2]] - a);
    const Eigen::Vector3d wanted =
        samples.normals[t[0]] + samples.normals[t[1]] + samples.normals[t[2]];
    if (normal.dot(wanted) < 0.0) std::swap(t[1], t[2]);
}

}  // namespace
}  // namespace dollytrack

/// CGAL orders equally good candidates by the addresses of their edges, which differ from run to
/// run. This order uses the edges' numbers instead.
template <>
struct std::less<dollytrack::FrontCandidate> {
    bool operator()(const dollytrack::FrontCandidate& a,
                    const dollytrack::FrontCandidate& b) const {
        if (a.first != b.first) return a.first < b.first;
        if (a.second == b.second) return false;
        return dollytrack::numberOf(a.second) < dollytrack::numberOf(b.second);
    }
};

namespace dollytrack {

Result<CloudSurface> meshCloud(const CloudSamples& samples, const CloudParams& params,
                               const JobContext& job) {
    CloudSurface surface;
    if (samples.points.size() < 3) return surface;
    std::vector<std::pair<Kernel::Point_3, std::size_t>> points;
    points.reserve(samples.points.size());
    // Coplanar or cospherical points make the tetrahedra ambiguous, so move them imperceptibly.
    Random random(1);
    const double off = 1e-4 * samples.voxel_m;
    for (const Eigen::Vector3d& p : samples.points) {
        const double x = p.x() + random.uniform(-off, off);
        const double y = p.y() + random.uniform(-off, off);
        const double z = p.z() + random.uniform(-off, off);
        points.emplace_back(Kernel::Point_3(x, y, z), points.size());
    }
    std::vector<std::array<std::size_t, 3>> faces;
    const double longest = std::max(params.gap_m, 5.0 * samples.voxel_m);
    CGAL::get_default_random() = CGAL::Random(0);  // independent of earlier uses
    edgeNumbers().clear();
    try {
        Tetrahedra tetrahedra(points.begin(), points.end());
        job.report(0.3);
        CGAL::Advancing_front_surface_reconstruction<Tetrahedra, ShortEdges> front(
            tetrahedra, ShortEdges{longest * longest, &job});
        front.run();
        CGAL::write_triple_indices(std::back_inserter(faces), front);
    } catch (const Stopped&) {
        return fail(ErrorCode::Cancelled, "import was cancelled");
    }
    edgeNumbers().clear();
    job.report(0.8);
    for (const auto& f : faces) {
        Triangle t = {static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]),
                      static_cast<std::uint32_t>(f[2])};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        surface.triangles.push_back(t);
    }
    // CGAL's order depends on addresses.
    std::sort(surface.triangles.begin(), surface.triangles.end());
    const std::vector<Triangle> filling =
        fillHoles(samples.points, surface.triangles, params.hole_m, surface.holes_filled);
    surface.hole_triangles = filling.size();
    surface.triangles.insert(surface.triangles.end(), filling.begin(), filling.end());
    for (Triangle& t : surface.triangles) face(samples, t);
    job.report(1.0);
    return surface;
}

}  // namespace dollytrack
