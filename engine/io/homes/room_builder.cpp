#include "engine/io/homes/room_builder.h"

#include "engine/geometry/flat_region.h"
#include "engine/io/homes/svg_path.h"
#include "engine/io/homes/wall_builder.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace dollytrack::homes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Outline = std::vector<Vector2d>;

const Eigen::Vector3f kFloor(0.45F, 0.42F, 0.38F);
const Eigen::Vector3f kCeiling(0.9F, 0.9F, 0.9F);

/// The holes of staircases that pass through this height, in the plan.
std::vector<Outline> stairHoles(const Home& home, double height) {
    std::vector<Outline> holes;
    for (const HomePiece& piece : home.pieces) {
        if (piece.floor_cut_out.empty()) continue;
        const double bottom = levelElevation(home, piece.level) + piece.elevation;
        if (height <= bottom + 1.0 || height > bottom + piece.height + 1.0) continue;
        const Eigen::Rotation2Dd turn(piece.angle);
        for (const Outline& outline : outlinesOfPath(piece.floor_cut_out)) {
            Outline hole;
            for (const Vector2d& p : outline) {
                const double x = (p.x() - 0.5) * (piece.mirrored ? -1.0 : 1.0);
                hole.push_back(piece.position +
                               turn * Vector2d(x * piece.width, (p.y() - 0.5) * piece.depth));
            }
            holes.push_back(std::move(hole));
        }
    }
    return holes;
}

template <class HeightAt>
void addFlat(const HomeRoom& room, const std::vector<Outline>& holes, const HomeSurface& surface,
             std::uint32_t material, const HeightAt& height_at, const Vector3d& outward,
             SurfaceMesh& mesh) {
    const FlatMesh flat = triangulateRegion(room.points, holes);
    const Vector2d repeat = surface.texture
                                ? Vector2d(surface.texture->width_cm, surface.texture->height_cm)
                                : Vector2d(100.0, 100.0);
    for (const auto& triangle : flat.triangles) {
        std::array<Vector3d, 3> corners;
        std::array<Vector2d, 3> uvs;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector2d& p = flat.corners[triangle[i]];
            corners[i] = {p.x(), height_at(p), p.y()};
            uvs[i] = {p.x() / repeat.x(), -p.y() / repeat.y()};
        }
        mesh.triangle(material, corners, uvs, outward);
    }
}

/// Height of the top of the level's wall nearest to a position; `otherwise` without walls.
double wallTop(const Home& home, int level, const Vector2d& place, double otherwise) {
    double nearest = std::numeric_limits<double>::max();
    double top = otherwise;
    for (const HomeWall& wall : home.walls) {
        if (wall.level != level) continue;
        const Vector2d along = wall.end - wall.start;
        const double square = along.squaredNorm();
        if (!(square > 0.0)) continue;
        const double share = std::clamp((place - wall.start).dot(along) / square, 0.0, 1.0);
        const double away = (place - wall.start - share * along).norm();
        if (away >= nearest) continue;
        nearest = away;
        top = levelElevation(home, wall.level) + wall.height +
              share * (wall.height_at_end - wall.height);
    }
    return top;
}

bool isLastLevel(const Home& home, int level) {
    if (level < 0) return true;
    const double own = home.levels[level].elevation;
    return std::none_of(home.levels.begin(), home.levels.end(),
                        [&](const auto& other) { return other.elevation > own + 1e-6; });
}

}  // namespace

SurfaceMesh buildFloor(const Home& home, const HomeRoom& room, HomeMaterials& materials) {
    SurfaceMesh mesh;
    if (!room.floor_visible || room.points.size() < 3) return mesh;
    const double height = levelElevation(home, room.level);
    const std::uint32_t material = materials.of(room.floor, kFloor);
    const std::vector<Outline> holes =
        room.level < 0 ? std::vector<Outline>{} : stairHoles(home, height);
    addFlat(
        room, holes, room.floor, material, [&](const Vector2d&) { return height; },
        Vector3d::UnitY(), mesh);
    if (room.level < 0 || mesh.empty()) return mesh;
    const double below = height - home.levels[room.level].floor_thickness;
    for (const Outline& hole : holes) {
        Vector2d middle = Vector2d::Zero();
        for (const Vector2d& p : hole) middle += p / static_cast<double>(hole.size());
        for (std::size_t i = 0; i < hole.size(); ++i) {
            const Vector2d& a = hole[i];
            const Vector2d& b = hole[(i + 1) % hole.size()];
            const Vector2d inward = middle - 0.5 * (a + b);
            mesh.quad(material,
                      {Vector3d(a.x(), height, a.y()), Vector3d(b.x(), height, b.y()),
                       Vector3d(b.x(), below, b.y()), Vector3d(a.x(), below, a.y())},
                      {inward.x(), 0.0, inward.y()});
        }
    }
    return mesh;
}

SurfaceMesh buildCeiling(const Home& home, const HomeRoom& room, HomeMaterials& materials) {
    SurfaceMesh mesh;
    if (!room.ceiling_visible || room.points.size() < 3) return mesh;
    const double flat = room.level < 0
                            ? home.wall_height
                            : levelElevation(home, room.level) + home.levels[room.level].height;
    const bool last = isLastLevel(home, room.level);
    addFlat(
        room, stairHoles(home, flat), room.ceiling, materials.of(room.ceiling, kCeiling),
        [&](const Vector2d& p) { return last ? wallTop(home, room.level, p, flat) : flat; },
        -Vector3d::UnitY(), mesh);
    return mesh;
}

}  // namespace dollytrack::homes
