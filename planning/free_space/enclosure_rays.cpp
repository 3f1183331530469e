#include "planning/free_space/enclosure_rays.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/voxelize.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

namespace dollytrack::planning {
namespace {

struct Step {
    int x = 0;
    int y = 0;
};
constexpr std::array<Step, 16> kAzimuths = {{{1, 0},
                                             {2, 1},
                                             {1, 1},
                                             {1, 2},
                                             {0, 1},
                                             {-1, 2},
                                             {-1, 1},
                                             {-2, 1},
                                             {-1, 0},
                                             {-2, -1},
                                             {-1, -1},
                                             {-1, -2},
                                             {0, -1},
                                             {1, -2},
                                             {1, -1},
                                             {2, -1}}};

/// One horizontal slice with a border of empty cells, so that steps need no bounds checks.
class Slice {
  public:
    Slice(int nx, int ny) : nx_(nx), ny_(ny), stride_(static_cast<std::size_t>(nx) + 2 * kBorder) {
        const std::size_t size = stride_ * (static_cast<std::size_t>(ny) + 2 * kBorder);
        wall_.assign(size, 0);
        hit_.assign(size, 0);
        hits_.assign(size, 0);
    }

    [[nodiscard]] std::size_t rowOf(int y) const {
        return (static_cast<std::size_t>(y) + kBorder) * stride_ + kBorder;
    }
    std::uint8_t* walls(int y) { return wall_.data() + rowOf(y); }
    [[nodiscard]] const std::uint8_t* hits(int y) const { return hits_.data() + rowOf(y); }

    /// Counts for every cell the directions in which it meets a wall.
    void countHits() {
        std::ranges::fill(hits_, std::uint8_t{0});
        for (const Step& step : kAzimuths) sweep(step);
    }

  private:
    static constexpr std::size_t kBorder = 2;

    // A cell meets a wall in a direction if a cell up to the next step is a wall, or if the cell at
    // the next step meets one.
    void sweep(const Step& step) {
        std::ranges::fill(hit_, std::uint8_t{0});
        const auto stride = static_cast<std::ptrdiff_t>(stride_);
        const std::ptrdiff_t next = step.y * stride + step.x;
        // The two cells that a knight's move passes between; other steps pass none.
        std::ptrdiff_t near_side = next;
        std::ptrdiff_t far_side = next;
        if (std::abs(step.x) == 2) {
            near_side = step.x / 2;
            far_side = near_side + step.y * stride;
        } else if (std::abs(step.y) == 2) {
            near_side = step.y / 2 * stride;
            far_side = near_side + step.x;
        }
        for (int i = 0; i < ny_; ++i) {
            const std::size_t row = rowOf(step.y > 0 ? ny_ - 1 - i : i);
            const std::uint8_t* wall = wall_.data() + row;
            std::uint8_t* hit = hit_.data() + row;
            std::uint8_t* hits = hits_.data() + row;
            if (step.y == 0) {
                for (int k = 0; k < nx_; ++k) {
                    const std::ptrdiff_t x = step.x > 0 ? nx_ - 1 - k : k;
                    hit[x] = wall[x + next] | hit[x + next];
                    hits[x] = static_cast<std::uint8_t>(hits[x] + hit[x]);
                }
            } else {
                // The previous row is finished, so all cells of this one are independent.
                const std::uint8_t* before = hit + next;
                const std::uint8_t* a = wall + near_side;
                const std::uint8_t* b = wall + far_side;
                const std::uint8_t* c = wall + next;
                for (std::ptrdiff_t x = 0; x < nx_; ++x) {
                    hit[x] = static_cast<std::uint8_t>(a[x] | b[x] | c[x] | before[x]);
                    hits[x] = static_cast<std::uint8_t>(hits[x] + hit[x]);
                }
            }
        }
    }

    int nx_;
    int ny_;
    std::size_t stride_;
    std::vector<std::uint8_t> wall_;
    std::vector<std::uint8_t> hit_;
    std::vector<std::uint8_t> hits_;
};

/// Sets the bits for surfaces below and above: one pass up and one down through the columns of the
/// box. The two bits must be 0 there.
void lookUpAndDown(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces,
                   const CellBox& box, std::vector<std::uint8_t>& ray_bits) {
    parallelFor(box.size(1), [&](std::size_t row_in_box) {
        const int y = box.begin[1] + static_cast<int>(row_in_box);
        std::vector<std::uint8_t> seen(box.size(0));
        const auto pass = [&](int z, std::uint8_t bit) {
            const std::size_t row = grid.indexOf(box.begin[0], y, z);
            for (std::size_t x = 0; x < seen.size(); ++x) {
                ray_bits[row + x] = static_cast<std::uint8_t>(ray_bits[row + x] | (seen[x] * bit));
                seen[x] |= static_cast<std::uint8_t>((surfaces[row + x] & kBuilding) / kBuilding);
            }
        };
        for (int z = 0; z < grid.count[2]; ++z) pass(z, kFloorBelow);
        std::ranges::fill(seen, std::uint8_t{0});
        for (int z = grid.count[2] - 1; z >= 0; --z) pass(z, kCeilingAbove);
    });
}

/// The bits that make an upright surface a wall. Furniture must not wall in a terrace, but in a
/// scene that marks almost no structure every surface may be a wall.
std::uint8_t wallBits(const std::vector<std::uint8_t>& surfaces) {
    constexpr unsigned kUpright = kBuilding | kSteep;
    constexpr double kEnoughStructure = 0.05;
    std::int64_t upright = 0;
    std::int64_t structure = 0;
    constexpr std::size_t kPart = 128;  // few enough for 8-bit sums, which SIMD adds many at a time
    for (std::size_t begin = 0; begin < surfaces.size(); begin += kPart) {
        const std::size_t end = std::min(begin + kPart, surfaces.size());
        std::uint8_t some = 0;
        std::uint8_t of_structure = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint8_t cell = surfaces[i];
            some += (cell & kUpright) == kUpright ? 1 : 0;
            of_structure += (cell & (kUpright | kStructure)) == (kUpright | kStructure) ? 1 : 0;
        }
        upright += some;
        structure += of_structure;
    }
    return static_cast<double>(structure) > kEnoughStructure * static_cast<double>(upright)
               ? kBuilding | kStructure
               : kBuilding;
}

/// Counts the directions with walls in these slices. The bits of the count must be 0.
void lookLevel(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces, std::uint8_t wall,
               const std::vector<int>& slices, std::vector<std::uint8_t>& ray_bits,
               const JobContext& job) {
    parallelRanges(slices.size(), 1, [&](std::size_t begin, std::size_t end) {
        Slice slice(grid.count[0], grid.count[1]);
        for (std::size_t at = begin; at < end; ++at) {
            const int z = slices[at];
            if (job.cancelled()) return;
            for (int y = 0; y < grid.count[1]; ++y) {
                const std::size_t row = grid.rowOf(y, z);
                std::uint8_t* walls = slice.walls(y);
                for (int x = 0; x < grid.count[0]; ++x) {
                    const std::uint8_t surface = surfaces[row + static_cast<std::size_t>(x)];
                    walls[x] = (surface & wall) == wall ? 1 : 0;
                }
            }
            slice.countHits();
            for (int y = 0; y < grid.count[1]; ++y) {
                std::uint8_t* row = ray_bits.data() + grid.rowOf(y, z);
                const std::uint8_t* hits = slice.hits(y);
                for (int x = 0; x < grid.count[0]; ++x) row[x] |= hits[x];
            }
        }
    });
}

void clearBits(std::uint8_t bits, const CellBox& box, const VoxelGrid& grid,
               std::vector<std::uint8_t>& cells) {
    visitRows(box, grid, [&](std::size_t begin, std::size_t end, int, int, int) {
        for (std::size_t i = begin; i < end; ++i) {
            cells[i] &= static_cast<std::uint8_t>(~unsigned{bits});
        }
    });
}

/// The slices whose walls differ.
std::vector<int> slicesAfter(const std::vector<CellBox>& changed, const VoxelGrid& grid,
                             const std::vector<std::uint8_t>& before, std::uint8_t wall_before,
                             const std::vector<std::uint8_t>& now, std::uint8_t wall) {
    std::vector<std::uint8_t> differs(grid.count[2], wall != wall_before ? 1 : 0);
    for (const CellBox& box : changed) {
        visitRows(box, grid, [&](std::size_t begin, std::size_t end, int, int, int z) {
            for (std::size_t i = begin; i < end; ++i) {
                if (((before[i] & wall) == wall) == ((now[i] & wall) == wall)) continue;
                differs[z] = 1;
                return;
            }
        });
    }
    std::vector<int> slices;
    for (std::size_t z = 0; z < differs.size(); ++z) {
        if (differs[z] != 0) slices.push_back(static_cast<int>(z));
    }
    return slices;
}

}  // namespace

std::vector<std::uint8_t> castEnclosureRays(const VoxelGrid& grid,
                                            const std::vector<std::uint8_t>& surfaces,
                                            const JobContext& job) {
    std::vector<std::uint8_t> ray_bits(grid.size(), 0);
    lookUpAndDown(grid, surfaces, wholeGrid(grid), ray_bits);
    std::vector<int> slices(grid.count[2]);
    std::iota(slices.begin(), slices.end(), 0);
    lookLevel(grid, surfaces, wallBits(surfaces), slices, ray_bits, job);
    return ray_bits;
}

std::vector<std::uint8_t> updateEnclosureRays(const std::vector<std::uint8_t>& before,
                                              const std::vector<std::uint8_t>& surfaces_before,
                                              const VoxelGrid& grid,
                                              const std::vector<std::uint8_t>& surfaces,
                                              std::vector<CellBox>& changed,
                                              const JobContext& job) {
    std::vector<std::uint8_t> ray_bits = before;
    if (changed.empty()) return ray_bits;
    const std::uint8_t wall = wallBits(surfaces);
    const std::vector<int> slices =
        slicesAfter(changed, grid, surfaces_before, wallBits(surfaces_before), surfaces, wall);
    std::vector<CellBox> looked;
    for (CellBox box : changed) {
        box.begin[2] = 0;
        box.end[2] = grid.count[2];
        looked.push_back(box);
    }
    looked = apart(looked);
    for (const CellBox& columns : looked) {
        clearBits(kFloorBelow | kCeilingAbove, columns, grid, ray_bits);
        lookUpAndDown(grid, surfaces, columns, ray_bits);
    }
    for (const int z : slices) {
        const CellBox slice = {{0, 0, z}, {grid.count[0], grid.count[1], z + 1}};
        clearBits(kEnclosureHitsMask, slice, grid, ray_bits);
        looked.push_back(slice);
    }
    lookLevel(grid, surfaces, wall, slices, ray_bits, job);
    changed = apart(looked);
    return ray_bits;
}

}  // namespace dollytrack::planning
