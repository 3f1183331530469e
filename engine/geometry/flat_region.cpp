#include "engine/geometry/flat_region.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <map>

namespace dollytrack {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Structure =
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                         CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

bool encloses(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p) {
    bool inside = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        const Eigen::Vector2d& a = outline[i];
        const Eigen::Vector2d& b = outline[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
            inside = !inside;
        }
    }
    return inside;
}

void insertOutline(const std::vector<Eigen::Vector2d>& outline, Triangulation& cdt) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2d& a = outline[i];
        const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
        if (a == b) continue;
        cdt.insert_constraint(Kernel::Point_2(a.x(), a.y()), Kernel::Point_2(b.x(), b.y()));
    }
}

}  // namespace

FlatMesh triangulateRegion(const std::vector<Eigen::Vector2d>& outline,
                           const std::vector<std::vector<Eigen::Vector2d>>& holes) {
    FlatMesh mesh;
    if (outline.size() < 3) return mesh;
    Triangulation cdt;
    insertOutline(outline, cdt);
    for (const auto& hole : holes) {
        if (hole.size() >= 3) insertOutline(hole, cdt);
    }
    std::map<Triangulation::Vertex_handle, std::uint32_t> indices;
    for (auto face = cdt.finite_faces_begin(); face != cdt.finite_faces_end(); ++face) {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        for (int i = 0; i < 3; ++i) {
            const auto& p = face->vertex(i)->point();
            middle += Eigen::Vector2d(p.x(), p.y()) / 3.0;
        }
        if (!encloses(outline, middle)) continue;
        if (std::any_of(holes.begin(), holes.end(), [&](const auto& hole) {
                return hole.size() >= 3 && encloses(hole, middle);
            })) {
            continue;
        }
        std::array<std::uint32_t, 3> triangle{};
        for (int i = 0; i < 3; ++i) {
            const auto vertex = face->vertex(i);
            const auto [found, is_new] =
                indices.try_emplace(vertex, static_cast<std::uint32_t>(mesh.corners.size()));
            if (is_new) mesh.corners.emplace_back(vertex->point().x(), vertex->point().y());
            triangle[i] = found->second;
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

}  // namespace dollytrack
