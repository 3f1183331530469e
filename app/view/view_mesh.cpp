#include "app/view/view_mesh.h"

#include "app/view/surface_colors.h"
#include "engine/jobs/parallel.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace dollytrack::view {
namespace {

constexpr double kLargestStored = 65535.0;
// Simplification tolerances, m, tried in order.
constexpr std::array<float, 6> kTolerances = {0.002F, 0.005F, 0.01F, 0.02F, 0.04F, 0.08F};

using Place = std::array<std::uint16_t, 3>;

/// An object's mesh during simplification.
struct ObjectMesh {
    int object_id = 0;
    std::vector<Place> places;
    std::vector<Eigen::Vector3f> points;  // vertex positions relative to the mesh's origin, m
    std::vector<Eigen::Vector3f> colors;  // linear RGB
    std::vector<std::uint32_t> corners;
};

struct Grid {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    double step = 1.0;

    [[nodiscard]] Place placeOf(const Eigen::Vector3f& position) const {
        const Eigen::Vector3d at = (position.cast<double>() - origin) / step;
        Place place{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double value =
                std::clamp(at[static_cast<Eigen::Index>(axis)], 0.0, kLargestStored);
            place[axis] = static_cast<std::uint16_t>(std::lround(value));
        }
        return place;
    }
};

bool isShown(const Object& object, const std::vector<bool>& hidden) {
    const std::size_t id = object.id;
    return object.triangle_count > 0 && (id >= hidden.size() || !hidden[id]);
}

Grid gridOf(const Scene& scene, const std::vector<const Object*>& objects) {
    Eigen::AlignedBox3f box;
    for (const Object* object : objects) {
        for (std::uint32_t v = 0; v < object->vertex_count; ++v) {
            box.extend(scene.positions[object->first_vertex + v]);
        }
    }
    if (box.isEmpty()) return {};
    const double size = static_cast<double>(box.sizes().maxCoeff());
    return {box.min().cast<double>(), std::max(size, 1e-3) / kLargestStored};
}

/// A mesh in which vertices with equal position and material are merged. Vertex colours are the
/// area-weighted mean of the triangles' colours.
ObjectMesh joinedMesh(const Scene& scene, const Object& object, const Grid& grid) {
    ObjectMesh mesh;
    mesh.object_id = object.id;
    std::map<std::pair<Place, std::uint32_t>, std::uint32_t> known;
    std::vector<float> weights;
    const auto vertexOf = [&](std::uint32_t index, std::uint32_t material) {
        const Place place = grid.placeOf(scene.positions[index]);
        const auto [at, is_new] =
            known.try_emplace({place, material}, static_cast<std::uint32_t>(mesh.places.size()));
        if (is_new) {
            const auto step = static_cast<float>(grid.step);
            mesh.places.push_back(place);
            mesh.points.emplace_back(step * static_cast<float>(place[0]),
                                     step * static_cast<float>(place[1]),
                                     step * static_cast<float>(place[2]));
            mesh.colors.emplace_back(Eigen::Vector3f::Zero());
            weights.push_back(0.0F);
        }
        return at->second;
    };
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const std::uint32_t triangle = object.first_triangle + i;
        if (isClear(scene, triangle)) continue;
        const std::uint32_t material = scene.triangle_material[triangle];
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t c = 0; c < 3; ++c) {
            corners[c] = vertexOf(scene.triangles[triangle][c], material);
        }
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
            continue;
        }
        const Eigen::Vector3f& first = mesh.points[corners[0]];
        const float area =
            (mesh.points[corners[1]] - first).cross(mesh.points[corners[2]] - first).norm() +
            1e-12F;
        const Eigen::Vector3f color = triangleColor(scene, triangle);
        for (const std::uint32_t corner : corners) {
            mesh.colors[corner] += area * color;
            weights[corner] += area;
            mesh.corners.push_back(corner);
        }
    }
    for (std::size_t v = 0; v < weights.size(); ++v) {
        if (weights[v] > 0.0F) mesh.colors[v] /= weights[v];
    }
    return mesh;
}

void simplify(ObjectMesh& mesh, float tolerance_m) {
    if (mesh.corners.empty()) return;
    const float* points = mesh.points.front().data();
    const float scale = meshopt_simplifyScale(points, mesh.points.size(), sizeof(Eigen::Vector3f));
    if (!(scale > 0.0F)) return;
    std::vector<std::uint32_t> fewer(mesh.corners.size());
    fewer.resize(meshopt_simplify(fewer.data(), mesh.corners.data(), mesh.corners.size(), points,
                                  mesh.points.size(), sizeof(Eigen::Vector3f), 0,
                                  tolerance_m / scale, 0, nullptr));
    // A small flat object may vanish completely; then it is kept unchanged.
    if (!fewer.empty()) mesh.corners = std::move(fewer);
}

/// Simplifies without preserving topology, as a last resort for very fine scenes.
void simplifyToShare(ObjectMesh& mesh, double share) {
    constexpr std::size_t kFewest = 3 * 12;
    const auto target = static_cast<std::size_t>(share * static_cast<double>(mesh.corners.size()));
    if (mesh.corners.size() <= kFewest) return;
    std::vector<std::uint32_t> fewer(mesh.corners.size());
    fewer.resize(meshopt_simplifySloppy(fewer.data(), mesh.corners.data(), mesh.corners.size(),
                                        mesh.points.front().data(), mesh.points.size(),
                                        sizeof(Eigen::Vector3f), std::max(target, kFewest),
                                        std::numeric_limits<float>::max(), nullptr));
    mesh.corners = std::move(fewer);
}

std::size_t trianglesIn(const std::vector<ObjectMesh>& meshes) {
    std::size_t corners = 0;
    for (const ObjectMesh& mesh : meshes) corners += mesh.corners.size();
    return corners / 3;
}

void makeFewer(std::vector<ObjectMesh>& meshes, std::size_t most_triangles) {
    for (const float tolerance : kTolerances) {
        if (trianglesIn(meshes) <= most_triangles) return;
        parallelFor(meshes.size(), [&](std::size_t i) { simplify(meshes[i], tolerance); });
    }
    const std::size_t count = trianglesIn(meshes);
    if (count <= most_triangles) return;
    const double share = static_cast<double>(most_triangles) / static_cast<double>(count);
    parallelFor(meshes.size(), [&](std::size_t i) { simplifyToShare(meshes[i], share); });
}

void append(ViewMesh& all, const ObjectMesh& mesh) {
    if (mesh.corners.empty()) return;
    constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> stored(mesh.places.size(), kNone);
    all.parts.push_back({mesh.object_id, static_cast<std::uint32_t>(all.corners.size()),
                         static_cast<std::uint32_t>(mesh.corners.size())});
    for (const std::uint32_t corner : mesh.corners) {
        if (stored[corner] == kNone) {
            stored[corner] = static_cast<std::uint32_t>(all.positions.size() / 3);
            const auto color = srgbBytes(mesh.colors[corner]);
            for (std::size_t i = 0; i < 3; ++i) {
                all.positions.push_back(mesh.places[corner][i]);
                all.colors.push_back(color[i]);
            }
        }
        all.corners.push_back(stored[corner]);
    }
}

}  // namespace

ViewMesh makeViewMesh(const Scene& scene, const std::vector<bool>& hidden,
                      std::size_t most_triangles) {
    std::vector<const Object*> objects;
    for (const Object& object : scene.objects) {
        if (isShown(object, hidden)) objects.push_back(&object);
    }
    const Grid grid = gridOf(scene, objects);
    std::vector<ObjectMesh> meshes(objects.size());
    parallelFor(objects.size(),
                [&](std::size_t i) { meshes[i] = joinedMesh(scene, *objects[i], grid); });
    ViewMesh all;
    all.origin = grid.origin;
    all.step_m = grid.step;
    all.scene_triangles = std::accumulate(
        objects.begin(), objects.end(), std::size_t{0},
        [](std::size_t sum, const Object* one) { return sum + one->triangle_count; });
    makeFewer(meshes, most_triangles);
    for (const ObjectMesh& mesh : meshes) append(all, mesh);
    return all;
}

}  // namespace dollytrack::view
