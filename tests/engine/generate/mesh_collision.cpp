#include "tests/engine/generate/mesh_collision.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

namespace dollytrack::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Face = Kernel::Triangle_3;
using Faces = std::vector<Face>;
using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, Faces::const_iterator>;

Faces facesOf(const Scene& scene, const Object& object) {
    Faces faces;
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const Triangle& t = scene.triangles[object.first_triangle + i];
        const auto point = [&](int k) {
            const Eigen::Vector3f& p = scene.positions[t[k]];
            return Kernel::Point_3(p.x(), p.y(), p.z());
        };
        const Face face(point(0), point(1), point(2));
        if (!face.is_degenerate()) faces.push_back(face);
    }
    return faces;
}

CGAL::Bbox_3 boundsOf(const Faces& faces) {
    CGAL::Bbox_3 box;
    for (const Face& face : faces) box += face.bbox();
    return box;
}

std::vector<Box> boxesIn(const Faces& faces, const CGAL::Bbox_3& where) {
    std::vector<Box> boxes;
    for (auto face = faces.begin(); face != faces.end(); ++face) {
        if (CGAL::do_overlap(face->bbox(), where)) boxes.emplace_back(face->bbox(), face);
    }
    return boxes;
}

struct Found {};

bool collide(const Faces& a, const Faces& b) {
    auto boxes_a = boxesIn(a, boundsOf(b));
    auto boxes_b = boxesIn(b, boundsOf(a));
    try {
        CGAL::box_intersection_d(boxes_a.begin(), boxes_a.end(), boxes_b.begin(), boxes_b.end(),
                                 [](const Box& x, const Box& y) {
                                     if (CGAL::do_intersect(*x.handle(), *y.handle()))
                                         throw Found{};
                                 });
    } catch (const Found&) {
        return true;
    }
    return false;
}

}  // namespace

std::vector<std::string> collisionsIn(const Scene& scene,
                                      bool (*skip)(const Object& a, const Object& b)) {
    std::vector<Faces> faces;
    std::vector<CGAL::Bbox_3> bounds;
    for (const Object& object : scene.objects) {
        faces.push_back(facesOf(scene, object));
        bounds.push_back(boundsOf(faces.back()));
    }
    std::vector<std::string> collisions;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (std::size_t k = i + 1; k < faces.size(); ++k) {
            if (skip(scene.objects[i], scene.objects[k])) continue;
            if (!CGAL::do_overlap(bounds[i], bounds[k]) || !collide(faces[i], faces[k])) continue;
            collisions.push_back(scene.objects[i].name + " - " + scene.objects[k].name);
        }
    }
    return collisions;
}

}  // namespace dollytrack::test
