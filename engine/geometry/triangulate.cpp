#include "engine/geometry/triangulate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Geometry>

#include <cmath>
#include <exception>

namespace dollytrack {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct FaceMark {
    int region = -1;
    bool inside = false;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using PlainFace = CGAL::Triangulation_face_base_with_info_2<FaceMark, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, PlainFace>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

/// Normal of a polygon with a length of twice its area (Newell).
Eigen::Vector3d newellNormal(std::span<const Eigen::Vector3f> corners) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const Eigen::Vector3d origin = corners[0].cast<double>();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Eigen::Vector3d a = corners[i].cast<double>() - origin;
        const Eigen::Vector3d b = corners[i + 1].cast<double>() - origin;
        normal += a.cross(b);
    }
    return normal;
}

/// Whether the area is larger than the rounding error of a line or point.
bool hasArea(const Eigen::Vector3d& newell, std::span<const Eigen::Vector3f> corners) {
    double longest = 0.0;
    for (const Eigen::Vector3f& corner : corners) {
        longest = std::max(longest, (corner - corners[0]).cast<double>().squaredNorm());
    }
    return std::isfinite(newell.norm()) && newell.norm() > 1e-7 * longest && longest > 0.0;
}

/// Splits a quad along the Delaunay diagonal, among the diagonals inside it. Returns false if
/// neither is inside (the quad crosses itself).
bool splitQuad(std::span<const Eigen::Vector3f> corners, const Eigen::Vector3d& normal,
               std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::array<Eigen::Vector3d, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = corners[i].cast<double>();
    const auto turn = [&](std::size_t i, std::size_t j, std::size_t k) {
        return (p[j] - p[i]).cross(p[k] - p[i]).dot(normal);
    };
    const double at_1 = turn(0, 1, 2);
    const double at_3 = turn(0, 2, 3);
    const double at_0 = turn(0, 1, 3);
    const double at_2 = turn(1, 2, 3);
    const double least = 1e-7 * normal.squaredNorm();
    const bool first = at_1 > least && at_3 > least;
    const bool second = at_0 > least && at_2 > least;
    if (!first && !second) return false;
    bool use_first = first;
    if (first && second) {
        // The angles opposite the diagonal sum to at most 180 degrees if their cotangents sum to at
        // least 0. For a rectangle both diagonals qualify and the first is used.
        const double across =
            (p[0] - p[1]).dot(p[2] - p[1]) / at_1 + (p[0] - p[3]).dot(p[2] - p[3]) / at_3;
        use_first = across >= -1e-6 / normal.norm();
    }
    if (use_first) {
        triangles.push_back({0, 1, 2});
        triangles.push_back({0, 2, 3});
    } else {
        triangles.push_back({0, 1, 3});
        triangles.push_back({1, 2, 3});
    }
    return true;
}

void appendFan(std::span<const Eigen::Vector3f> corners,
               std::vector<std::array<std::uint32_t, 3>>& triangles) {
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.push_back({0, i, i + 1});
}

using Outline = std::vector<Kernel::Point_2>;

/// Even-odd rule, so that an edge that occurs twice (the bridge to a hole) has no effect.
bool isInside(const Outline& outline, double x, double y) {
    bool inside = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        const auto& a = outline[i];
        const auto& b = outline[j];
        if ((a.y() > y) != (b.y() > y) &&
            x < (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()) + a.x()) {
            inside = !inside;
        }
    }
    return inside;
}

/// Marks the faces inside the outline: one test for each region bounded by edges, at the centre of
/// its largest triangle, where rounding cannot change the result.
void markInside(Triangulation& cdt, const Outline& outline) {
    int region = 0;
    for (auto seed = cdt.finite_faces_begin(); seed != cdt.finite_faces_end(); ++seed) {
        if (seed->info().region >= 0) continue;
        std::vector<Triangulation::Face_handle> faces = {seed};
        seed->info().region = region;
        Triangulation::Face_handle largest = seed;
        double largest_area = -1.0;
        for (std::size_t k = 0; k < faces.size(); ++k) {
            const Triangulation::Face_handle face = faces[k];
            const double area = cdt.triangle(face).area();
            if (area > largest_area) {
                largest_area = area;
                largest = face;
            }
            for (int i = 0; i < 3; ++i) {
                const Triangulation::Face_handle next = face->neighbor(i);
                if (face->is_constrained(i) || cdt.is_infinite(next)) continue;
                if (next->info().region >= 0) continue;
                next->info().region = region;
                faces.push_back(next);
            }
        }
        double x = 0.0;
        double y = 0.0;
        for (int i = 0; i < 3; ++i) {
            x += largest->vertex(i)->point().x() / 3.0;
            y += largest->vertex(i)->point().y() / 3.0;
        }
        const bool inside = isInside(outline, x, y);
        for (const Triangulation::Face_handle face : faces) face->info().inside = inside;
        ++region;
    }
}

PolygonOutcome triangulateGeneral(std::span<const Eigen::Vector3f> corners,
                                  const Eigen::Vector3d& normal,
                                  std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const Eigen::Vector3d z = normal.normalized();
    const Eigen::Vector3d x = z.unitOrthogonal();
    const Eigen::Vector3d y = z.cross(x);
    Outline outline;
    for (const Eigen::Vector3f& corner : corners) {
        const Eigen::Vector3d p = (corner - corners[0]).cast<double>();
        outline.emplace_back(p.dot(x), p.dot(y));
    }
    Triangulation cdt;
    std::vector<Triangulation::Vertex_handle> vertices;
    for (std::uint32_t i = 0; i < outline.size(); ++i) {
        const std::size_t before = cdt.number_of_vertices();
        vertices.push_back(cdt.insert(outline[i]));
        if (cdt.number_of_vertices() > before) vertices.back()->info() = i;
    }
    const std::size_t corner_count = cdt.number_of_vertices();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const auto& next = vertices[(i + 1) % vertices.size()];
        if (vertices[i] != next) cdt.insert_constraint(vertices[i], next);
    }
    // CGAL adds vertices where edges cross.
    if (cdt.number_of_vertices() != corner_count) {
        appendFan(corners, triangles);
        return PolygonOutcome::Approximate;
    }
    markInside(cdt, outline);
    const std::size_t before = triangles.size();
    for (auto face = cdt.finite_faces_begin(); face != cdt.finite_faces_end(); ++face) {
        if (!face->info().inside) continue;
        triangles.push_back(
            {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
    return triangles.size() > before ? PolygonOutcome::Exact : PolygonOutcome::Degenerate;
}

}  // namespace

PolygonOutcome triangulatePolygon(std::span<const Eigen::Vector3f> corners,
                                  std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() < 3) return PolygonOutcome::Degenerate;
    const Eigen::Vector3d normal = newellNormal(corners);
    if (!hasArea(normal, corners)) return PolygonOutcome::Degenerate;
    if (corners.size() == 3) {
        triangles.push_back({0, 1, 2});
        return PolygonOutcome::Exact;
    }
    if (corners.size() == 4 && splitQuad(corners, normal, triangles)) return PolygonOutcome::Exact;
    const std::size_t before = triangles.size();
    try {
        return triangulateGeneral(corners, normal, triangles);
    } catch (const std::exception&) {  // from CGAL's checks
        triangles.resize(before);
        appendFan(corners, triangles);
        return PolygonOutcome::Approximate;
    }
}

}  // namespace dollytrack
