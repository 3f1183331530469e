#include "engine/geometry/mesh_normals.h"

#include "engine/geometry/vertex_join.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace dollytrack {

std::vector<Eigen::Vector3f> cornerNormals(std::span<const Eigen::Vector3f> positions,
                                           std::span<const std::array<std::uint32_t, 3>> triangles,
                                           double crease_deg) {
    // Files often repeat a position for every face: what counts is the place, not the index.
    VertexJoin<3> places(positions.size());
    std::vector<std::uint32_t> place(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const auto& p = positions[i];
        place[i] = places.insert({p.x(), p.y(), p.z()});
    }
    std::vector<Eigen::Vector3f> area_normal(triangles.size());
    std::vector<std::uint32_t> first(places.size() + 1, 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        area_normal[t] = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
        for (const std::uint32_t v : triangles[t]) ++first[place[v] + 1];
    }
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<std::uint32_t> around(3 * triangles.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (const std::uint32_t v : triangles[t]) around[next[place[v]]++] = t;
    }

    const auto least_cosine =
        static_cast<float>(std::cos(crease_deg * std::numbers::pi / 180.0) - 1e-6);
    std::vector<Eigen::Vector3f> unit(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) unit[t] = area_normal[t].normalized();
    std::vector<Eigen::Vector3f> normals(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t at = place[triangles[t][corner]];
            Eigen::Vector3f sum = Eigen::Vector3f::Zero();
            for (std::uint32_t k = first[at]; k < first[at + 1]; ++k) {
                const std::uint32_t other = around[k];
                if (unit[t].dot(unit[other]) >= least_cosine) sum += area_normal[other];
            }
            const float length = sum.norm();
            normals[3 * t + corner] = length > 0.0F ? Eigen::Vector3f(sum / length) : unit[t];
        }
    }
    return normals;
}

}  // namespace dollytrack
