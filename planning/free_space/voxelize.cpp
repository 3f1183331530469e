#include "planning/free_space/voxelize.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace dollytrack::planning {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Cells are tested slightly enlarged, so that rounding never loses a contact.
constexpr double kInflate = 1e-4;  // in cells
constexpr double kSteepCosine = 0.7;

/// Overlap test of a triangle with grid cells, in units of cells (Schwarz and Seidel, "Fast
/// parallel surface and solid voxelization on GPUs", 2010): a cell overlaps if the plane passes
/// through it and its square overlaps the triangle in all three axis projections.
class TriangleCells {
  public:
    TriangleCells(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        const std::array<Vector3d, 3> corners = {a, b, c};
        normal_ = (b - a).cross(c - b);
        plane_ = normal_.dot(a);
        normal_.cwiseAbs().maxCoeff(&w_);
        low_ = a.cwiseMin(b).cwiseMin(c).array() - kInflate;
        high_ = a.cwiseMax(b).cwiseMax(c).array() + kInflate;
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            const double side = normal_[axis] < 0.0 ? -1.0 : 1.0;
            for (unsigned i = 0; i < 3; ++i) {
                const Vector3d edge = corners[(i + 1) % 3] - corners[i];
                Edge& made = edges_[static_cast<unsigned>(axis)][i];
                made.u = -edge[v] * side;
                made.v = edge[u] * side;
                made.offset = -(made.u * corners[i][u] + made.v * corners[i][v]) +
                              std::max(0.0, made.u) + std::max(0.0, made.v) +
                              kInflate * (std::abs(made.u) + std::abs(made.v));
            }
        }
    }

    /// Calls mark(cell) for the cells of the window that the triangle overlaps.
    template <class Mark>
    void visit(const CellBox& window, Mark&& mark) const {
        std::array<int, 3> begin;
        std::array<int, 3> last;
        for (unsigned k = 0; k < 3; ++k) {
            const double bottom = window.begin[k];
            const double top = window.end[k] - 1.0;
            if (high_[k] < bottom || low_[k] >= top + 1.0) return;
            begin[k] = static_cast<int>(std::clamp(std::floor(low_[k]), bottom, top));
            last[k] = static_cast<int>(std::clamp(std::floor(high_[k]), bottom, top));
        }
        const auto w = static_cast<unsigned>(w_);
        const unsigned u = (w + 1) % 3;
        const unsigned v = (w + 2) % 3;
        const bool flat = std::abs(normal_[w_]) > 0.0;
        std::array<int, 3> cell;
        for (cell[v] = begin[v]; cell[v] <= last[v]; ++cell[v]) {
            for (cell[u] = begin[u]; cell[u] <= last[u]; ++cell[u]) {
                if (!overlaps(w, cell[u], cell[v])) continue;
                const auto [low, high] = flat
                                             ? planeRange(u, v, cell[u], cell[v], begin[w], last[w])
                                             : std::pair(begin[w], last[w]);
                for (cell[w] = low; cell[w] <= high; ++cell[w]) {
                    if (overlaps(u, cell[v], cell[w]) && overlaps(v, cell[w], cell[u])) mark(cell);
                }
            }
        }
    }

  private:
    struct Edge {
        double u = 0.0;
        double v = 0.0;
        double offset = 0.0;
    };

    /// Whether a cell's square overlaps the triangle in the projection along `axis`, apart from the
    /// test of bounding boxes.
    [[nodiscard]] bool overlaps(unsigned axis, int u, int v) const {
        return std::ranges::all_of(edges_[axis], [&](const Edge& edge) {
            return edge.u * u + edge.v * v + edge.offset >= 0.0;
        });
    }

    /// The cells along the normal's largest axis that the plane crosses in one column.
    [[nodiscard]] std::pair<int, int> planeRange(unsigned u, unsigned v, int at_u, int at_v,
                                                 int begin, int last) const {
        const double slope_u = -normal_[u] / normal_[w_];
        const double slope_v = -normal_[v] / normal_[w_];
        const double middle =
            plane_ / normal_[w_] + slope_u * (at_u + 0.5) + slope_v * (at_v + 0.5);
        const double reach = (0.5 + kInflate) * (std::abs(slope_u) + std::abs(slope_v)) + kInflate;
        return {std::max(begin, static_cast<int>(std::floor(std::max(-1.0, middle - reach)))),
                std::min(last, static_cast<int>(std::floor(std::min(1e9, middle + reach))))};
    }

    Vector3d normal_;
    double plane_ = 0.0;
    Eigen::Index w_ = 0;  // dominant axis of the normal
    Vector3d low_;
    Vector3d high_;
    std::array<std::array<Edge, 3>, 3> edges_;  // by projection axis
};

/// CellSurface bits of an object. Ground planes and skies extend far outside the room; an object
/// that spans the whole room is its shell, whatever its name.
std::uint8_t surfaceKind(const Object& object, const Eigen::AlignedBox3d& room) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& corner : object.box.corners()) box.extend(corner);
    const Vector3d margin = (0.1 * room.sizes()).cwiseMax(1.0);
    const bool beyond = ((box.min() + margin).array() < room.min().array()).any() ||
                        ((box.max() - margin).array() > room.max().array()).any();
    const Vector3d shared = box.intersection(room).sizes();
    const bool spans = (shared.array() >= 0.8 * room.sizes().array()).all();
    unsigned kind = kSurface;
    if (!beyond) kind |= kBuilding;
    if (beyond || spans || object.structure) kind |= kStructure;
    return static_cast<std::uint8_t>(kind);
}

// Objects are split into work items, so that one large mesh does not occupy one thread.
constexpr std::uint32_t kPieceTriangles = 512;

struct Piece {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::size_t object = 0;
    std::uint8_t kind = 0;
    SurfaceReach reach = {};
};

void addPieces(const Scene& scene, std::size_t index, std::vector<Piece>& pieces) {
    const Object& object = scene.objects[index];
    const std::uint8_t kind = surfaceKind(object, scene.room_bounds);
    const std::uint32_t end = object.first_triangle + object.triangle_count;
    for (std::uint32_t t = object.first_triangle; t < end; t += kPieceTriangles) {
        pieces.push_back({t, std::min(end, t + kPieceTriangles), index, kind});
    }
}

/// Calls visit(corners, box) for the triangles of a piece, in units of cells from the grid's first
/// corner.
template <class Visit>
void visitTriangles(const Scene& scene, const VoxelGrid& grid, const Piece& piece, Visit&& visit) {
    const Vector3d origin(grid.first[0], grid.first[1], grid.first[2]);
    for (std::uint32_t t = piece.begin; t < piece.end; ++t) {
        std::array<Vector3d, 3> p;
        for (unsigned k = 0; k < 3; ++k) {
            p[k] =
                scene.positions[scene.triangles[t][k]].cast<double>() / grid.resolution_m - origin;
        }
        if ((p[0] + p[1] + p[2]).hasNaN()) continue;
        const Vector3d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
        const Vector3d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
        if (low.allFinite() && high.allFinite()) visit(p, Eigen::AlignedBox3d(low, high));
    }
}

void measureReach(const Scene& scene, const VoxelGrid& grid, Piece& piece) {
    piece.reach.gap_beyond_m.fill(std::numeric_limits<double>::infinity());
    const Vector3d size(grid.count[0], grid.count[1], grid.count[2]);
    visitTriangles(scene, grid, piece, [&](const auto&, const Eigen::AlignedBox3d& box) {
        piece.reach.box_in_cells.extend(box);
        for (unsigned k = 0; k < 3; ++k) {
            double& below = piece.reach.gap_beyond_m[2 * k];
            double& above = piece.reach.gap_beyond_m[2 * k + 1];
            const double low = box.min()[k];
            const double high = box.max()[k];
            if (low < 0.0) below = std::min(below, std::max(0.0, -high) * grid.resolution_m);
            if (high > size[k]) {
                above = std::min(above, std::max(0.0, low - size[k]) * grid.resolution_m);
            }
        }
    });
}

/// Marks the cells of the windows that the triangles of a piece touch. Threads may mark the same
/// cell; bits are only ever set, so their order does not matter.
void mark(const Scene& scene, const VoxelGrid& grid, const Piece& piece,
          const std::vector<CellBox>& windows, std::vector<std::uint8_t>& cells) {
    visitTriangles(scene, grid, piece, [&](const auto& p, const Eigen::AlignedBox3d& box) {
        const auto reaches = [&](const CellBox& window) {
            for (unsigned k = 0; k < 3; ++k) {
                if (box.max()[k] < window.begin[k] - 1.0 || box.min()[k] > window.end[k] + 1.0) {
                    return false;
                }
            }
            return true;
        };
        if (std::ranges::none_of(windows, reaches)) return;
        const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
        const bool steep = std::abs(normal.z()) < kSteepCosine * normal.norm();
        const auto kind = static_cast<std::uint8_t>(piece.kind | (steep ? unsigned{kSteep} : 0U));
        const TriangleCells triangle(p[0], p[1], p[2]);
        for (const CellBox& window : windows) {
            triangle.visit(window, [&](const std::array<int, 3>& c) {
                std::atomic_ref<std::uint8_t> at(cells[grid.indexOf(c[0], c[1], c[2])]);
                if ((at.load(std::memory_order_relaxed) & kind) != kind) {
                    at.fetch_or(kind, std::memory_order_relaxed);
                }
            });
        }
    });
}

void join(SurfaceReach& all, const SurfaceReach& part) {
    all.box_in_cells.extend(part.box_in_cells);
    for (unsigned k = 0; k < 6; ++k) {
        all.gap_beyond_m[k] = std::min(all.gap_beyond_m[k], part.gap_beyond_m[k]);
    }
}

/// The reach of an object without triangles.
SurfaceReach nowhere() {
    SurfaceReach reach;
    reach.gap_beyond_m.fill(std::numeric_limits<double>::infinity());
    return reach;
}

void joinReaches(SurfaceCells& result) {
    SurfaceReach all = nowhere();
    for (const SurfaceReach& reach : result.reach) join(all, reach);
    result.gap_beyond_m = all.gap_beyond_m;
}

}  // namespace

SurfaceCells voxelize(const Scene& scene, const VoxelGrid& grid, const JobContext& job) {
    SurfaceCells result;
    result.cells.assign(grid.size(), 0);
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) addPieces(scene, i, pieces);
    const std::vector<CellBox> everywhere = {wholeGrid(grid)};
    parallelFor(pieces.size(), [&](std::size_t index) {
        if (job.cancelled()) return;
        measureReach(scene, grid, pieces[index]);
        mark(scene, grid, pieces[index], everywhere, result.cells);
    });
    result.reach.assign(scene.objects.size(), nowhere());
    for (const Piece& piece : pieces) join(result.reach[piece.object], piece.reach);
    joinReaches(result);
    return result;
}

SurfaceCells voxelizeMoved(const SurfaceCells& before, const Scene& scene, const VoxelGrid& grid,
                           const std::vector<int>& moved, std::vector<CellBox>& changed,
                           const JobContext& job) {
    SurfaceCells result = before;
    std::vector<Piece> moved_pieces;
    for (const int id : moved) {
        const auto index = static_cast<std::size_t>(id) - 1;
        addPieces(scene, index, moved_pieces);
        result.reach[index] = nowhere();
    }
    parallelFor(moved_pieces.size(),
                [&](std::size_t i) { measureReach(scene, grid, moved_pieces[i]); });
    for (const Piece& piece : moved_pieces) join(result.reach[piece.object], piece.reach);
    joinReaches(result);

    std::vector<CellBox> touched;
    for (const int id : moved) {
        const auto index = static_cast<std::size_t>(id) - 1;
        touched.push_back(cellsAround(grid, before.reach[index].box_in_cells));
        touched.push_back(cellsAround(grid, result.reach[index].box_in_cells));
    }
    touched = apart(touched);
    for (const CellBox& window : touched) {
        visitRows(window, grid, [&](std::size_t begin, std::size_t end, int, int, int) {
            std::fill(result.cells.begin() + static_cast<std::ptrdiff_t>(begin),
                      result.cells.begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{0});
        });
    }
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const CellBox reach = cellsAround(grid, result.reach[i].box_in_cells);
        const auto meets = [&](const CellBox& window) { return overlap(reach, window); };
        if (std::ranges::any_of(touched, meets)) addPieces(scene, i, pieces);
    }
    parallelFor(pieces.size(), [&](std::size_t i) {
        if (!job.cancelled()) mark(scene, grid, pieces[i], touched, result.cells);
    });
    changed.clear();
    for (const CellBox& window : touched) {
        const CellBox box = changedIn(window, grid, before.cells, result.cells);
        if (!box.empty()) changed.push_back(box);
    }
    return result;
}

}  // namespace dollytrack::planning
