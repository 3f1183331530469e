#include "engine/io/raw_scene/mesh_part_builder.h"

#include "engine/geometry/mesh_normals.h"
#include "engine/geometry/triangulate.h"
#include "engine/geometry/vertex_join.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace dollytrack {
namespace {

constexpr float kAlongAxis = 0.99939F;  // cosine of 2 degrees

enum class Place : char { Good, TooFar, NoNumber };  // of a vertex; a face has its worst vertex's

Place judge(const Eigen::Vector3f& corner) {
    if (!corner.allFinite()) return Place::NoNumber;
    return corner.cwiseAbs().maxCoeff() <= kFarthest ? Place::Good : Place::TooFar;
}

/// The valid faces, as triangles with indices into the mesh's vertices.
std::vector<Triangle> collectTriangles(const SourceMesh& mesh,
                                       const std::vector<Eigen::Vector3f>& placed,
                                       const std::vector<Place>& places, RepairCounts& counts) {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.face_indices.size() / 2);
    std::vector<Eigen::Vector3f> corners;
    std::vector<Triangle> cut;
    std::size_t first = 0;
    for (const std::uint32_t size : mesh.face_sizes) {
        const auto face = mesh.face_indices.subspan(first, size);
        first += size;
        if (size < 3) {
            ++counts.lines;
            continue;
        }
        bool in_range = true;
        Place worst = Place::Good;
        for (const std::uint32_t v : face) {
            in_range = in_range && v < placed.size();
            if (in_range) worst = std::max(worst, places[v]);
        }
        if (!in_range || worst != Place::Good) {
            ++(!in_range                  ? counts.bad_indices
               : worst == Place::NoNumber ? counts.bad_numbers
                                          : counts.too_far);
            continue;
        }
        corners.clear();
        for (const std::uint32_t v : face) corners.push_back(placed[v]);
        cut.clear();
        counts.polygons += size > 3;
        switch (triangulatePolygon(corners, cut)) {
            case PolygonOutcome::Exact:
                break;
            case PolygonOutcome::Approximate:
                ++counts.approximate;
                break;
            case PolygonOutcome::Degenerate:
                ++counts.no_area;
                break;
        }
        for (const Triangle& t : cut) triangles.push_back({face[t[0]], face[t[1]], face[t[2]]});
    }
    return triangles;
}

/// Gives equal vertices the same number, in order of first appearance. Vertices are compared only
/// with those at the same position. -0 and 0 are equal.
class VertexWelder {
  public:
    explicit VertexWelder(std::size_t places) : first_(places, kEnd) { vertices_.reserve(places); }

    std::uint32_t insert(std::uint32_t place, const Eigen::Vector3f& normal,
                         const Eigen::Vector2f& uv) {
        const Bits bits = {bitsOf(normal.x()), bitsOf(normal.y()), bitsOf(normal.z()),
                           bitsOf(uv.x()), bitsOf(uv.y())};
        std::uint32_t* link = &first_[place];
        while (*link != kEnd) {
            if (equal(vertices_[*link].bits, bits)) return *link;
            link = &vertices_[*link].next;
        }
        const auto added = static_cast<std::uint32_t>(vertices_.size());
        *link = added;
        vertices_.push_back({bits, kEnd});
        return added;
    }

  private:
    using Bits = std::array<std::uint32_t, 5>;
    struct Vertex {
        Bits bits;
        std::uint32_t next;  // next vertex at the same position
    };

    static std::uint32_t bitsOf(float x) { return std::bit_cast<std::uint32_t>(x + 0.0F); }
    static bool equal(const Bits& a, const Bits& b) {
        return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2]) | (a[3] ^ b[3]) | (a[4] ^ b[4])) == 0;
    }

    static constexpr std::uint32_t kEnd = 0xFFFFFFFFU;
    std::vector<std::uint32_t> first_;  // first vertex by position
    std::vector<Vertex> vertices_;
};

}  // namespace

void RepairCounts::add(const RepairCounts& other) {
    bad_numbers += other.bad_numbers;
    too_far += other.too_far;
    bad_indices += other.bad_indices;
    no_area += other.no_area;
    approximate += other.approximate;
    polygons += other.polygons;
    lines += other.lines;
    made_normals += other.made_normals;
    mirrored += other.mirrored;
}

void measurePart(MeshPart& part) {
    part.bounds.setEmpty();
    part.facing_area.fill(0.0);
    part.area = 0.0;
    for (const Eigen::Vector3f& p : part.positions) part.bounds.extend(p);
    for (const Triangle& t : part.triangles) {
        const Eigen::Vector3f& a = part.positions[t[0]];
        const Eigen::Vector3f normal = (part.positions[t[1]] - a).cross(part.positions[t[2]] - a);
        const float length = normal.norm();
        if (!std::isfinite(length)) continue;  // the square overflows
        part.area += 0.5 * static_cast<double>(length);
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(normal[axis]) < kAlongAxis * length) continue;
            part.facing_area[2 * axis + (normal[axis] > 0.0F)] += 0.5 * static_cast<double>(length);
        }
    }
}

RepairCounts buildMeshPart(const SourceMesh& mesh, const Eigen::Affine3d& source_from_mesh,
                           MeshPart& part) {
    RepairCounts counts;
    const Eigen::Matrix3d linear = source_from_mesh.linear();
    const double determinant = linear.determinant();
    const bool mirrors = determinant < 0.0;
    counts.mirrored = mirrors;
    const bool moves = !source_from_mesh.isApprox(Eigen::Affine3d::Identity(), 0.0);

    std::vector<Eigen::Vector3f> placed(mesh.positions.begin(), mesh.positions.end());
    std::vector<Place> places(placed.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (moves) placed[i] = (source_from_mesh * placed[i].cast<double>()).cast<float>();
        places[i] = judge(placed[i]);
    }
    std::vector<Triangle> triangles = collectTriangles(mesh, placed, places, counts);
    if (mirrors) {
        for (Triangle& t : triangles) std::swap(t[1], t[2]);
    }

    const bool has_normals = mesh.normals.size() == placed.size() && !placed.empty();
    std::vector<Eigen::Vector3f> made;
    std::vector<std::uint32_t> place;
    if (!has_normals && !triangles.empty()) {
        ++counts.made_normals;
        made = cornerNormals(placed, triangles, 45.0, &place);
    }
    // The cofactor matrix: correct for any scale, and keeps normals outward under mirroring.
    Eigen::Matrix3d cofactors;
    cofactors.col(0) = linear.col(1).cross(linear.col(2));
    cofactors.col(1) = linear.col(2).cross(linear.col(0));
    cofactors.col(2) = linear.col(0).cross(linear.col(1));
    if (mirrors) cofactors = -cofactors;
    const Eigen::Matrix3f turn = cofactors.cast<float>();
    const bool has_uvs = mesh.uvs.size() == placed.size();

    VertexJoin<8> join(has_normals ? std::min(placed.size(), 3 * triangles.size()) : 0);
    VertexWelder welder(place.size());
    part.triangles.reserve(triangles.size());
    const std::size_t likely = triangles.size();  // a closed smooth mesh has half as many
    part.positions.reserve(likely);
    part.normals.reserve(likely);
    part.uvs.reserve(likely);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        Triangle joined;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t v = triangles[t][corner];
            Eigen::Vector3f normal;
            if (has_normals) {
                normal = mesh.normals[v];
                if (moves) normal = turn * normal;
                const float length = normal.norm();
                if (!(length > 1e-20F) || !std::isfinite(length)) {
                    const Eigen::Vector3f& a = placed[triangles[t][0]];
                    normal = (placed[triangles[t][1]] - a).cross(placed[triangles[t][2]] - a);
                }
                normal.normalize();
            } else {
                normal = made[3 * t + corner];
            }
            // Vectors whose squared length underflows or overflows have no direction.
            if (!normal.allFinite()) normal = Eigen::Vector3f::UnitZ();
            Eigen::Vector2f uv = Eigen::Vector2f::Zero();
            if (has_uvs && mesh.uvs[v].head<2>().allFinite()) uv = mesh.uvs[v].head<2>();
            const Eigen::Vector3f& p = placed[v];
            joined[corner] = has_normals ? join.insert({p.x(), p.y(), p.z(), normal.x(), normal.y(),
                                                        normal.z(), uv.x(), uv.y()})
                                         : welder.insert(place[v], normal, uv);
            if (joined[corner] == part.positions.size()) {
                part.positions.push_back(p);
                part.normals.push_back(normal);
                part.uvs.push_back(uv);
            }
        }
        part.triangles.push_back(joined);
    }
    measurePart(part);
    return counts;
}

}  // namespace dollytrack
