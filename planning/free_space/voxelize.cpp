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

// Cells are tested a little larger than they are, so that rounding never loses a touch.
constexpr double kInflate = 1e-4;  // cells
constexpr double kSteepCosine = 0.7;

/// The overlap test of a triangle with the cells of a grid, in units of cells (Schwarz and Seidel,
/// "Fast parallel surface and solid voxelization on GPUs", 2010): a cell overlaps when the plane
/// passes through it and its square overlaps the triangle in all three axis projections.
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

    template <class Mark>
    void visit(const std::array<int, 3>& count, Mark&& mark) const {
        std::array<int, 3> begin;
        std::array<int, 3> last;
        for (unsigned k = 0; k < 3; ++k) {
            const double top = count[k] - 1.0;
            if (high_[k] < 0.0 || low_[k] >= top + 1.0) return;
            begin[k] = static_cast<int>(std::clamp(std::floor(low_[k]), 0.0, top));
            last[k] = static_cast<int>(std::clamp(std::floor(high_[k]), 0.0, top));
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

    /// Whether a cell's square overlaps the triangle in the projection along `axis`, apart from
    /// the triangle's bounding box.
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
    Eigen::Index w_ = 0;  // the axis that the triangle faces most
    Vector3d low_;
    Vector3d high_;
    std::array<std::array<Edge, 3>, 3> edges_;  // by projection axis
};

/// Grounds and skies go on far outside the room; what spans the whole room is its shell, even
/// when its name does not say so.
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

}  // namespace

SurfaceCells voxelize(const Scene& scene, const VoxelGrid& grid, const JobContext& job) {
    SurfaceCells result;
    result.cells.assign(grid.size(), 0);
    const Vector3d origin(grid.first[0], grid.first[1], grid.first[2]);
    const Vector3d size(grid.count[0], grid.count[1], grid.count[2]);

    // Objects are cut into pieces of work, so that one large mesh does not keep one thread busy.
    struct Piece {
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint8_t kind = 0;
        std::array<double, 6> gap = {};
    };
    constexpr std::uint32_t kPieceTriangles = 512;
    std::vector<Piece> pieces;
    for (const Object& object : scene.objects) {
        const std::uint8_t kind = surfaceKind(object, scene.room_bounds);
        const std::uint32_t end = object.first_triangle + object.triangle_count;
        for (std::uint32_t t = object.first_triangle; t < end; t += kPieceTriangles) {
            pieces.push_back({t, std::min(end, t + kPieceTriangles), kind, {}});
        }
    }
    parallelFor(pieces.size(), [&](std::size_t index) {
        Piece& piece = pieces[index];
        piece.gap.fill(std::numeric_limits<double>::infinity());
        if (job.cancelled()) return;
        for (std::uint32_t t = piece.begin; t < piece.end; ++t) {
            std::array<Vector3d, 3> p;
            for (unsigned k = 0; k < 3; ++k) {
                p[k] = scene.positions[scene.triangles[t][k]].cast<double>() / grid.resolution_m -
                       origin;
            }
            const Vector3d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
            const Vector3d high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
            if (!low.allFinite() || !high.allFinite() || (p[0] + p[1] + p[2]).hasNaN()) continue;
            for (unsigned k = 0; k < 3; ++k) {
                double& below = piece.gap[2 * k];
                double& above = piece.gap[2 * k + 1];
                if (low[k] < 0.0) below = std::min(below, std::max(0.0, -high[k]));
                if (high[k] > size[k]) above = std::min(above, std::max(0.0, low[k] - size[k]));
            }
            const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
            const bool steep = std::abs(normal.z()) < kSteepCosine * normal.norm();
            const auto kind =
                static_cast<std::uint8_t>(piece.kind | (steep ? unsigned{kSteep} : 0U));
            TriangleCells(p[0], p[1], p[2]).visit(grid.count, [&](const std::array<int, 3>& c) {
                // Several threads may mark one cell; bits only get set, so their order is the same
                // to the result.
                std::atomic_ref<std::uint8_t> at(result.cells[grid.indexOf(c[0], c[1], c[2])]);
                if ((at.load(std::memory_order_relaxed) & kind) != kind) {
                    at.fetch_or(kind, std::memory_order_relaxed);
                }
            });
        }
    });
    result.gap_beyond_m.fill(std::numeric_limits<double>::infinity());
    for (const Piece& piece : pieces) {
        for (unsigned k = 0; k < 6; ++k) {
            double& gap = result.gap_beyond_m[k];
            gap = std::min(gap, piece.gap[k] * grid.resolution_m);
        }
    }
    return result;
}

}  // namespace dollytrack::planning
