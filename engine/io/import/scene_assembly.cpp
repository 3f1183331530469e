#include "engine/io/import/scene_assembly.h"

#include "engine/core/huge_pages.h"
#include "engine/geometry/object_measure.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

void copyPart(const MeshPart& part, std::uint32_t vertex, std::uint32_t triangle, Scene& scene) {
    std::copy(part.positions.begin(), part.positions.end(), scene.positions.begin() + vertex);
    std::copy(part.normals.begin(), part.normals.end(), scene.normals.begin() + vertex);
    std::copy(part.uvs.begin(), part.uvs.end(), scene.uvs.begin() + vertex);
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
        Triangle moved = part.triangles[i];
        for (std::uint32_t& index : moved) index += vertex;
        scene.triangles[triangle + i] = moved;
        scene.triangle_material[triangle + i] = part.material;
    }
}

/// Sets an object's front, made horizontal. A front that points up or down is ignored.
void giveFront(const Eigen::Vector3d& front_in_source, const Eigen::Affine3d& source_from_world,
               Object& object) {
    Eigen::Vector3d front = source_from_world.linear().inverse() * front_in_source;
    front.z() = 0.0;
    if (!(front.norm() > 1e-9)) return;
    object.front = front.normalized();
    object.front_source = FrontSource::Annotation;
}

}  // namespace

void moveToWorld(std::vector<MeshPart>& parts, const Eigen::Affine3d& world_from_source) {
    if (world_from_source.isApprox(Eigen::Affine3d::Identity(), 0.0)) return;
    const Eigen::Matrix3f turn = world_from_source.linear().cast<float>();
    const Eigen::Vector3d shift = world_from_source.translation();
    const bool shifts = !shift.isZero(0.0);
    const double unit = std::cbrt(world_from_source.linear().determinant());
    const Eigen::Matrix3f normal_turn = (world_from_source.linear() / unit).cast<float>();
    parallelFor(parts.size(), [&](std::size_t i) {
        MeshPart& part = parts[i];
        part.bounds.setEmpty();
        for (Eigen::Vector3f& p : part.positions) {
            p = shifts ? Eigen::Vector3f((world_from_source * p.cast<double>()).cast<float>())
                       : Eigen::Vector3f(turn * p);
            part.bounds.extend(p);
        }
        for (Eigen::Vector3f& n : part.normals) n = normal_turn * n;
        part.area *= unit * unit;
    });
}

void assembleObjects(std::vector<MeshPart>& parts, const std::vector<ObjectDraft>& drafts,
                     Scene& scene) {
    struct Place {
        std::size_t part;
        std::uint32_t vertex;
        std::uint32_t triangle;
    };
    std::vector<Place> places;
    std::uint32_t vertex = 0;
    std::uint32_t triangle = 0;
    for (const ObjectDraft& draft : drafts) {
        Object object;
        object.id = static_cast<int>(scene.objects.size()) + 1;
        object.name = draft.name;
        object.nyu40 = draft.label.nyu40;
        object.structure = draft.label.kind == LabelKind::Structure;
        if (object.structure) object.role = Role::Structure;
        if (draft.front) giveFront(*draft.front, scene.source_from_world, object);
        object.first_vertex = vertex;
        object.first_triangle = triangle;
        for (const std::size_t index : draft.parts) {
            places.push_back({index, vertex, triangle});
            vertex += static_cast<std::uint32_t>(parts[index].positions.size());
            triangle += static_cast<std::uint32_t>(parts[index].triangles.size());
        }
        object.vertex_count = vertex - object.first_vertex;
        object.triangle_count = triangle - object.first_triangle;
        scene.objects.push_back(std::move(object));
    }
    resizeLarge(scene.positions, vertex);
    resizeLarge(scene.normals, vertex);
    resizeLarge(scene.uvs, vertex);
    resizeLarge(scene.triangles, triangle);
    resizeLarge(scene.triangle_material, triangle);
    parallelFor(places.size(), [&](std::size_t i) {
        MeshPart& part = parts[places[i].part];
        copyPart(part, places[i].vertex, places[i].triangle, scene);
        part = MeshPart{};
    });
    parallelFor(scene.objects.size(),
                [&](std::size_t i) { measureObject(scene, scene.objects[i]); });
}

}  // namespace dollytrack
