#include "engine/io/homes/wall_builder.h"

#include "engine/geometry/flat_region.h"
#include "engine/io/homes/svg_path.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dollytrack::homes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Outline = std::vector<Vector2d>;

const Eigen::Vector3f kPlaster(0.86F, 0.86F, 0.84F);

Vector3d lifted(const Vector2d& in_plan, double height) {
    return {in_plan.x(), height, in_plan.y()};
}

/// Builds one segment of a wall, in coordinates along the segment (s) and elevation (z).
class WallSegmentBuilder {
  public:
    WallSegmentBuilder(const HomeWall& wall, const WallSegment& segment, double bottom,
                       double floor, HomeMaterials& materials, SurfaceMesh& mesh)
        : wall_(wall),
          segment_(segment),
          along_(segment.along()),
          left_(segment.leftward()),
          origin_(0.5 * (segment.left_start + segment.right_start)),
          bottom_(bottom),
          top_start_(floor + heightAt(segment.from)),
          top_end_(floor + heightAt(segment.to)),
          floor_(floor),
          left_material_(materials.of(wall.left, kPlaster)),
          right_material_(materials.of(wall.right, kPlaster)),
          top_material_(materials.of(wall.top, kPlaster)),
          materials_(materials),
          mesh_(mesh) {}

    void addHole(const HomePiece& opening, double elevation, bool round) {
        const Vector2d across(std::cos(opening.angle), std::sin(opening.angle));
        const double straight = across.dot(along_);
        if (std::abs(straight) < (round ? 0.7 : 0.95)) return;
        const Vector2d offset = opening.position - origin_;
        if (std::abs(offset.dot(left_)) > 0.49 * (wall_.thickness + opening.depth)) return;
        const double s = offset.dot(along_);
        if (s + 0.5 * opening.width < lowestS() || s - 0.5 * opening.width > highestS()) return;
        const double turn = (opening.mirrored ? -straight : straight) * opening.width;
        for (const Outline& outline : outlinesOfPath(opening.wall_cut_out)) {
            Outline hole;
            for (const Vector2d& p : outline) {
                hole.emplace_back(s + (p.x() - 0.5) * turn,
                                  elevation + opening.height * (1.0 - p.y()));
            }
            holes_.push_back(std::move(hole));
        }
    }

    void build(bool cap_start, bool cap_end) {
        addSide(segment_.left_start, segment_.left_end, left_, left_material_, wall_.left);
        addSide(segment_.right_start, segment_.right_end, -left_, right_material_, wall_.right);
        for (const Outline& hole : holes_) addReveal(hole);
        mesh_.quad(top_material_,
                   {lifted(segment_.left_start, top_start_), lifted(segment_.left_end, top_end_),
                    lifted(segment_.right_end, top_end_), lifted(segment_.right_start, top_start_)},
                   Vector3d::UnitY());
        mesh_.quad(top_material_,
                   {lifted(segment_.left_start, bottom_), lifted(segment_.left_end, bottom_),
                    lifted(segment_.right_end, bottom_), lifted(segment_.right_start, bottom_)},
                   -Vector3d::UnitY());
        if (cap_start) {
            addCap(segment_.left_start, segment_.right_start, top_start_, -along_);
        }
        if (cap_end) addCap(segment_.left_end, segment_.right_end, top_end_, along_);
        if (wall_.left_baseboard) {
            addBaseboard(*wall_.left_baseboard, segment_.left_start, segment_.left_end, left_);
        }
        if (wall_.right_baseboard) {
            addBaseboard(*wall_.right_baseboard, segment_.right_start, segment_.right_end, -left_);
        }
    }

  private:
    [[nodiscard]] double heightAt(double share) const {
        return wall_.height + share * (wall_.height_at_end - wall_.height);
    }
    [[nodiscard]] double sOf(const Vector2d& p) const { return (p - origin_).dot(along_); }
    [[nodiscard]] double lowestS() const {
        return std::min(sOf(segment_.left_start), sOf(segment_.right_start));
    }
    [[nodiscard]] double highestS() const {
        return std::max(sOf(segment_.left_end), sOf(segment_.right_end));
    }

    void addSide(const Vector2d& start, const Vector2d& end, const Vector2d& outward,
                 std::uint32_t material, const HomeSurface& surface) {
        const double from = sOf(start);
        const double to = sOf(end);
        if (!(to - from > 1e-6)) return;
        const FlatMesh flat = triangulateRegion(
            {{from, bottom_}, {to, bottom_}, {to, top_end_}, {from, top_start_}}, holes_);
        const Vector2d repeat =
            surface.texture ? Vector2d(surface.texture->width_cm, surface.texture->height_cm)
                            : Vector2d(100.0, 100.0);
        for (const auto& triangle : flat.triangles) {
            std::array<Vector3d, 3> corners;
            std::array<Vector2d, 3> uvs;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vector2d& p = flat.corners[triangle[i]];
                corners[i] = lifted(start + (p.x() - from) / (to - from) * (end - start), p.y());
                uvs[i] = {p.x() / repeat.x(), (p.y() - floor_) / repeat.y()};
            }
            mesh_.triangle(material, corners, uvs, lifted(outward, 0.0));
        }
    }

    /// Adds the sides of a hole, from the wall's left to its right surface.
    void addReveal(const Outline& hole) {
        Vector2d middle = Vector2d::Zero();
        for (const Vector2d& p : hole) middle += p / static_cast<double>(hole.size());
        const double top = std::max(top_start_, top_end_);
        const double from = std::max(sOf(segment_.left_start), sOf(segment_.right_start));
        const double to = std::min(sOf(segment_.left_end), sOf(segment_.right_end));
        for (std::size_t i = 0; i < hole.size(); ++i) {
            Vector2d a = hole[i];
            Vector2d b = hole[(i + 1) % hole.size()];
            if (!clip(a, b, 0, from, to) || !clip(a, b, 1, bottom_, top)) continue;
            const auto at = [&](const Vector2d& p, double side) {
                const double half = 0.5 * wall_.thickness * side;
                return lifted(origin_ + p.x() * along_ + half * left_, p.y());
            };
            const Vector2d inward = middle - 0.5 * (a + b);
            mesh_.quad(left_material_, {at(a, 1.0), at(b, 1.0), at(b, -1.0), at(a, -1.0)},
                       lifted(inward.x() * along_, inward.y()));
        }
    }

    /// Clips the segment a-b to low..high along one coordinate. Returns false if nothing remains.
    static bool clip(Vector2d& a, Vector2d& b, int axis, double low, double high) {
        for (const auto& [limit, sign] : {std::pair(low, 1.0), std::pair(high, -1.0)}) {
            const double da = sign * (a[axis] - limit);
            const double db = sign * (b[axis] - limit);
            if (da < 0.0 && db < 0.0) return false;
            if (da < 0.0) a += da / (da - db) * (b - a);
            if (db < 0.0) b += db / (db - da) * (a - b);
        }
        return (a - b).norm() > 1e-6;
    }

    void addCap(const Vector2d& left, const Vector2d& right, double top, const Vector2d& outward) {
        mesh_.quad(
            left_material_,
            {lifted(left, bottom_), lifted(right, bottom_), lifted(right, top), lifted(left, top)},
            lifted(outward, 0.0));
    }

    void addBaseboard(const HomeBaseboard& board, const Vector2d& start, const Vector2d& end,
                      const Vector2d& outward) {
        const std::uint32_t material = materials_.of(board.surface, kPlaster);
        std::vector<std::pair<double, double>> gaps;
        for (const Outline& hole : holes_) {
            const auto [low_s, high_s] =
                std::minmax_element(hole.begin(), hole.end(),
                                    [](const auto& a, const auto& b) { return a.x() < b.x(); });
            const auto [low, high] =
                std::minmax_element(hole.begin(), hole.end(),
                                    [](const auto& a, const auto& b) { return a.y() < b.y(); });
            if (low->y() < floor_ + board.height && high->y() > floor_) {
                gaps.emplace_back(low_s->x(), high_s->x());
            }
        }
        std::sort(gaps.begin(), gaps.end());
        double at = sOf(start);
        const double last = sOf(end);
        gaps.emplace_back(last, last);
        for (const auto& [from, to] : gaps) {
            addBoard(material, board, start + (at - sOf(start)) * along_,
                     start + (std::min(from, last) - sOf(start)) * along_, outward);
            at = std::max(at, to);
        }
    }

    void addBoard(std::uint32_t material, const HomeBaseboard& board, const Vector2d& a,
                  const Vector2d& b, const Vector2d& outward) {
        if (!((b - a).dot(along_) > 0.01)) return;
        const Vector2d out = board.thickness * outward;
        const double top = floor_ + board.height;
        mesh_.quad(material,
                   {lifted(a + out, floor_), lifted(b + out, floor_), lifted(b + out, top),
                    lifted(a + out, top)},
                   lifted(outward, 0.0));
        mesh_.quad(material,
                   {lifted(a, top), lifted(b, top), lifted(b + out, top), lifted(a + out, top)},
                   Vector3d::UnitY());
        for (const Vector2d& p : {a, b}) {
            mesh_.quad(
                material,
                {lifted(p, floor_), lifted(p + out, floor_), lifted(p + out, top), lifted(p, top)},
                lifted(p == a ? Vector2d(-along_) : along_, 0.0));
        }
    }

    const HomeWall& wall_;
    const WallSegment& segment_;
    Vector2d along_;
    Vector2d left_;
    Vector2d origin_;
    double bottom_;
    double top_start_;
    double top_end_;
    double floor_;
    std::uint32_t left_material_;
    std::uint32_t right_material_;
    std::uint32_t top_material_;
    HomeMaterials& materials_;
    SurfaceMesh& mesh_;
    std::vector<Outline> holes_;
};

/// Elevation of a wall's bottom. Walls of upper levels extend down through their floor.
double wallBottom(const Home& home, int level) {
    if (level < 0) return 0.0;
    const HomeLevel& own = home.levels[level];
    const bool above = std::any_of(home.levels.begin(), home.levels.end(), [&](const auto& other) {
        return other.elevation < own.elevation;
    });
    return own.elevation - (above ? own.floor_thickness : 0.0);
}

}  // namespace

double levelElevation(const Home& home, int level) {
    return level < 0 ? 0.0 : home.levels[level].elevation;
}

SurfaceMesh buildWall(const Home& home, const HomeWall& wall,
                      const std::vector<WallSegment>& outline, HomeMaterials& materials) {
    SurfaceMesh mesh;
    const double floor = levelElevation(home, wall.level);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        WallSegmentBuilder segment(wall, outline[i], wallBottom(home, wall.level), floor, materials,
                                   mesh);
        for (const HomePiece& piece : home.pieces) {
            if (piece.kind != PieceKind::Opening) continue;
            segment.addHole(piece, levelElevation(home, piece.level) + piece.elevation,
                            outline.size() > 1);
        }
        segment.build(i == 0, i + 1 == outline.size());
    }
    return mesh;
}

}  // namespace dollytrack::homes
