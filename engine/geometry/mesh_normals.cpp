#include "engine/geometry/mesh_normals.h"

#include "engine/geometry/vertex_join.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <utility>

namespace dollytrack {

std::vector<Eigen::Vector3f> cornerNormals(std::span<const Eigen::Vector3f> positions,
                                           std::span<const std::array<std::uint32_t, 3>> triangles,
                                           double crease_deg,
                                           std::vector<std::uint32_t>* place_out) {
    // Files often repeat a position for every face, so vertices are compared by position, not by
    // index.
    VertexJoin<3> places(positions.size());
    std::vector<std::uint32_t> place(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const auto& p = positions[i];
        place[i] = places.insert({p.x(), p.y(), p.z()});
    }
    // The triangle corners at each position, in the order of the triangles.
    std::vector<std::uint32_t> first(places.size() + 1, 0);
    for (const auto& triangle : triangles) {
        for (const std::uint32_t v : triangle) ++first[place[v] + 1];
    }
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    struct Corner {
        Eigen::Vector3f area_normal;
        Eigen::Vector3f unit;
        std::size_t index;  // 3 * triangle + corner
    };
    std::vector<Corner> corners(3 * triangles.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        const Eigen::Vector3f area_normal =
            (positions[b] - positions[a]).cross(positions[c] - positions[a]);
        const Eigen::Vector3f unit = area_normal.normalized();
        for (std::size_t i = 0; i < 3; ++i) {
            corners[next[place[triangles[t][i]]]++] = {area_normal, unit, 3 * t + i};
        }
    }

    const auto least_cosine =
        static_cast<float>(std::cos(crease_deg * std::numbers::pi / 180.0) - 1e-6);
    std::vector<Eigen::Vector3f> normals(3 * triangles.size());
    for (std::size_t at = 0; at + 1 < first.size(); ++at) {
        const std::span around(corners.data() + first[at], first[at + 1] - first[at]);
        for (const Corner& corner : around) {
            Eigen::Vector3f sum = Eigen::Vector3f::Zero();
            for (const Corner& other : around) {
                if (corner.unit.dot(other.unit) >= least_cosine) sum += other.area_normal;
            }
            const float length = sum.norm();
            normals[corner.index] = length > 0.0F ? Eigen::Vector3f(sum / length) : corner.unit;
        }
    }
    if (place_out) *place_out = std::move(place);
    return normals;
}

}  // namespace dollytrack
