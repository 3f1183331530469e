#include "planning/free_space/distance_field.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::planning {
namespace {

// The squared gap of two cubes is the sum over the axes of max(0, |difference| - 1)^2, so it
// separates like the Euclidean distance transform (Felzenszwalb and Huttenlocher, 2012): one
// minimum per row, axis after axis. Neighbouring rows are minimised together, in steps outwards
// until no step can improve the result. In rooms few steps are needed, and 16-bit SIMD processes
// eight values at a time: about three times as fast as the lower envelope of parabolas.
constexpr int kLanes = 64;
using Lanes = std::array<std::uint16_t, kLanes>;

constexpr std::uint16_t squaredGap(int steps) {
    return static_cast<std::uint16_t>((steps - 1) * (steps - 1));
}

/// Squared gaps of a row's cells to the surfaces in the same row.
void scanRow(const std::uint8_t* surface, std::uint16_t* row, int count) {
    int away = kMaxGapCells + 1;
    for (int x = 0; x < count; ++x) {
        away = surface[x] != 0 ? 0 : std::min(away + 1, kMaxGapCells + 1);
        row[x] = static_cast<std::uint16_t>(away);
    }
    away = kMaxGapCells + 1;
    for (int x = count - 1; x >= 0; --x) {
        away = surface[x] != 0 ? 0 : std::min(away + 1, kMaxGapCells + 1);
        const int steps = std::min<int>(away, row[x]);
        row[x] = steps == 0 ? std::uint16_t{0} : squaredGap(steps);
    }
}

void minimise(Lanes& best, const Lanes& from, std::uint16_t extra) {
    for (unsigned i = 0; i < kLanes; ++i) {
        best[i] = std::min(best[i], static_cast<std::uint16_t>(from[i] + extra));
    }
}

std::uint16_t largest(const Lanes& lanes) {
    std::uint16_t result = 0;
    for (const std::uint16_t value : lanes) result = std::max(result, value);
    return result;
}

/// Minimises the cells [begin, end) of `count` along one axis, for up to kLanes rows adjacent in x.
void minimiseAlong(std::uint16_t* cells, std::size_t stride, int count, int begin, int end,
                   int lanes, std::vector<Lanes>& rows) {
    rows.resize(count);
    for (int i = 0; i < count; ++i) {
        Lanes& row = rows[i];
        std::copy_n(cells + static_cast<std::size_t>(i) * stride, lanes, row.begin());
        std::fill(row.begin() + lanes, row.end(), std::uint16_t{0});
    }
    for (int i = begin; i < end; ++i) {
        Lanes best = rows[i];
        for (int step = 1; step <= kMaxGapCells; ++step) {
            const std::uint16_t extra = squaredGap(step);
            if (extra >= largest(best)) break;
            if (i - step < 0 && i + step >= count) break;
            if (i - step >= 0) minimise(best, rows[i - step], extra);
            if (i + step < count) minimise(best, rows[i + step], extra);
        }
        std::copy_n(best.begin(), lanes, cells + static_cast<std::size_t>(i) * stride);
    }
}

/// Squared gap between a cell and the nearest cell of a box.
int squaredGapTo(const CellBox& box, int x, int y, int z) {
    const std::array<int, 3> at = {x, y, z};
    int sum = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const int away = std::max({box.begin[k] - at[k], at[k] - (box.end[k] - 1), 0});
        if (away > 1) sum += (away - 1) * (away - 1);
    }
    return sum;
}

std::uint16_t largest(const std::vector<std::uint16_t>& gaps, const CellBox& box,
                      const VoxelGrid& grid) {
    std::uint16_t found = 0;
    visitRows(box, grid, [&](std::size_t begin, std::size_t end, int, int, int) {
        std::uint16_t row = 0;
        for (const std::uint16_t* gap = gaps.data() + begin; gap != gaps.data() + end; ++gap) {
            row = std::max(row, *gap);
        }
        found = std::max(found, row);
    });
    return found;
}

/// Number of cells that is more than any of these gaps.
int stepsOver(std::uint16_t largest_squared_gap) {
    return static_cast<int>(std::sqrt(largest_squared_gap)) + 2;
}

/// Bounding box of `box` and the cells of `among` whose nearest surface may have been in `box` or
/// may be there now.
CellBox near(const CellBox& box, const CellBox& among, const VoxelGrid& grid,
             const std::vector<std::uint16_t>& gaps) {
    CellBox cells = box;
    visitRows(among, grid, [&](std::size_t begin, std::size_t end, int x, int y, int z) {
        for (std::size_t i = begin; i < end; ++i, ++x) {
            if (squaredGapTo(box, x, y, z) > gaps[i]) continue;
            const std::array<int, 3> at = {x, y, z};
            for (unsigned k = 0; k < 3; ++k) {
                cells.begin[k] = std::min(cells.begin[k], at[k]);
                cells.end[k] = std::max(cells.end[k], at[k] + 1);
            }
        }
    });
    return cells;
}

/// Computes the gaps of the cells in the box from surfaces up to `reach` cells outside it. Returns
/// false if surfaces farther away may be nearest for some cell.
bool gapsIn(const CellBox& box, int reach, const VoxelGrid& grid,
            const std::vector<std::uint8_t>& surface, std::vector<std::uint16_t>& gaps,
            const JobContext& job) {
    const CellBox from = grown(box, reach, grid);
    const int nx = box.size(0);
    const int ny = from.size(1);
    const int nz = from.size(2);
    const std::size_t row_stride = nx;
    const std::size_t slice_stride = row_stride * static_cast<std::size_t>(ny);
    std::vector<std::uint16_t> part(slice_stride * static_cast<std::size_t>(nz));
    const int skip_x = box.begin[0] - from.begin[0];
    const int skip_y = box.begin[1] - from.begin[1];
    const int skip_z = box.begin[2] - from.begin[2];
    parallelFor(nz, [&](std::size_t z) {
        if (job.cancelled()) return;
        std::vector<std::uint16_t> row(from.size(0));
        std::uint16_t* slice = part.data() + z * slice_stride;
        for (int y = 0; y < ny; ++y) {
            const std::size_t at =
                grid.indexOf(from.begin[0], from.begin[1] + y, from.begin[2] + static_cast<int>(z));
            scanRow(surface.data() + at, row.data(), from.size(0));
            std::copy_n(row.begin() + skip_x, nx, slice + static_cast<std::size_t>(y) * row_stride);
        }
        std::vector<Lanes> rows;
        for (int x = 0; x < nx; x += kLanes) {
            minimiseAlong(slice + x, row_stride, ny, skip_y, skip_y + box.size(1),
                          std::min(kLanes, nx - x), rows);
        }
    });
    // Surfaces farther away have at least this gap; outside the grid there are none.
    const bool all = from == wholeGrid(grid) || reach >= kMaxGapCells;
    const int sure = all ? int{kMaxSquaredGap} : reach * reach;
    std::vector<std::uint8_t> is_sure(box.size(1), 1);
    parallelFor(is_sure.size(), [&](std::size_t y) {
        if (job.cancelled()) return;
        std::vector<Lanes> rows;
        std::uint16_t* first = part.data() + (y + static_cast<std::size_t>(skip_y)) * row_stride;
        for (int x = 0; x < nx; x += kLanes) {
            minimiseAlong(first + x, slice_stride, nz, skip_z, skip_z + box.size(2),
                          std::min(kLanes, nx - x), rows);
        }
        for (int z = 0; z < box.size(2); ++z) {
            const std::uint16_t* made = first + static_cast<std::size_t>(skip_z + z) * slice_stride;
            if (*std::max_element(made, made + nx) > sure) is_sure[y] = 0;
            std::copy_n(made, nx,
                        gaps.begin() + static_cast<std::ptrdiff_t>(grid.indexOf(
                                           box.begin[0], box.begin[1] + static_cast<int>(y),
                                           box.begin[2] + z)));
        }
    });
    return std::ranges::count(is_sure, 0) == 0;
}

}  // namespace

std::vector<std::uint16_t> squaredGaps(const VoxelGrid& grid,
                                       const std::vector<std::uint8_t>& surface,
                                       const JobContext& job) {
    std::vector<std::uint16_t> gaps(grid.size());
    const auto [nx, ny, nz] = grid.count;
    const std::size_t row_stride = nx;
    const std::size_t slice_stride = row_stride * static_cast<std::size_t>(ny);
    parallelFor(nz, [&, nx = nx, ny = ny](std::size_t z) {
        if (job.cancelled()) return;
        std::uint16_t* slice = gaps.data() + z * slice_stride;
        for (std::size_t y = 0; y < static_cast<std::size_t>(ny); ++y) {
            scanRow(surface.data() + z * slice_stride + y * row_stride, slice + y * row_stride, nx);
        }
        std::vector<Lanes> rows;
        for (int x = 0; x < nx; x += kLanes) {
            minimiseAlong(slice + x, row_stride, ny, 0, ny, std::min(kLanes, nx - x), rows);
        }
    });
    parallelFor(ny, [&, nx = nx, nz = nz](std::size_t y) {
        if (job.cancelled()) return;
        std::vector<Lanes> rows;
        for (int x = 0; x < nx; x += kLanes) {
            minimiseAlong(gaps.data() + y * row_stride + x, slice_stride, nz, 0, nz,
                          std::min(kLanes, nx - x), rows);
        }
    });
    return gaps;
}

std::vector<std::uint16_t> squaredGapsAfter(const std::vector<std::uint16_t>& before,
                                            const std::vector<CellBox>& changed,
                                            const VoxelGrid& grid,
                                            const std::vector<std::uint8_t>& surface,
                                            const JobContext& job) {
    std::vector<std::uint16_t> gaps = before;
    if (changed.empty()) return gaps;
    const int furthest = stepsOver(largest(before, wholeGrid(grid), grid));
    for (const CellBox& box : changed) {
        const CellBox cells = near(box, grown(box, furthest, grid), grid, before);
        // After a surface was removed, the next one may be farther away than the old one was.
        int reach = stepsOver(largest(before, cells, grid));
        while (!gapsIn(cells, reach, grid, surface, gaps, job) && !job.cancelled()) reach *= 2;
    }
    return gaps;
}

}  // namespace dollytrack::planning
