#include "planning/free_space/distance_field.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>

namespace dollytrack::planning {
namespace {

// The squared gap of two cubes is the sum over the axes of max(0, |difference| - 1)^2, so it
// separates like the Euclidean distance transform (Felzenszwalb and Huttenlocher, 2012): one
// minimum a row, axis after axis. Rows next to each other are minimised together, step by step
// outwards until no step can help: in rooms that takes few steps, and 16-bit numbers add and
// compare eight at a time, which beats the lower envelope of parabolas about threefold.
constexpr int kLanes = 64;
using Lanes = std::array<std::uint16_t, kLanes>;

constexpr std::uint16_t squaredGap(int steps) {
    return static_cast<std::uint16_t>((steps - 1) * (steps - 1));
}

/// Gap of a row's cells to the row's own surfaces.
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

/// Minimises along one axis, for up to kLanes rows that lie side by side in x.
void minimiseAlong(std::uint16_t* cells, std::size_t stride, int count, int lanes,
                   std::vector<Lanes>& rows) {
    rows.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        Lanes& row = rows[static_cast<std::size_t>(i)];
        std::copy_n(cells + static_cast<std::size_t>(i) * stride, lanes, row.begin());
        std::fill(row.begin() + lanes, row.end(), std::uint16_t{0});
    }
    for (int i = 0; i < count; ++i) {
        Lanes best = rows[static_cast<std::size_t>(i)];
        for (int step = 1; step <= kMaxGapCells; ++step) {
            const std::uint16_t extra = squaredGap(step);
            if (extra >= largest(best)) break;
            if (i - step < 0 && i + step >= count) break;
            if (i - step >= 0) minimise(best, rows[static_cast<std::size_t>(i - step)], extra);
            if (i + step < count) minimise(best, rows[static_cast<std::size_t>(i + step)], extra);
        }
        std::copy_n(best.begin(), lanes, cells + static_cast<std::size_t>(i) * stride);
    }
}

}  // namespace

std::vector<std::uint16_t> squaredGaps(const VoxelGrid& grid,
                                       const std::vector<std::uint8_t>& surface,
                                       const JobContext& job) {
    std::vector<std::uint16_t> gaps(grid.size());
    const auto [nx, ny, nz] = grid.count;
    const auto row_stride = static_cast<std::size_t>(nx);
    const std::size_t slice_stride = row_stride * static_cast<std::size_t>(ny);
    parallelFor(static_cast<std::size_t>(nz), [&, nx = nx, ny = ny](std::size_t z) {
        if (job.cancelled()) return;
        std::uint16_t* slice = gaps.data() + z * slice_stride;
        for (std::size_t y = 0; y < static_cast<std::size_t>(ny); ++y) {
            scanRow(surface.data() + z * slice_stride + y * row_stride, slice + y * row_stride, nx);
        }
        std::vector<Lanes> rows;
        for (int x = 0; x < nx; x += kLanes) {
            minimiseAlong(slice + x, row_stride, ny, std::min(kLanes, nx - x), rows);
        }
    });
    parallelFor(static_cast<std::size_t>(ny), [&, nx = nx, nz = nz](std::size_t y) {
        if (job.cancelled()) return;
        std::vector<Lanes> rows;
        for (int x = 0; x < nx; x += kLanes) {
            minimiseAlong(gaps.data() + y * row_stride + x, slice_stride, nz,
                          std::min(kLanes, nx - x), rows);
        }
    });
    return gaps;
}

}  // namespace dollytrack::planning
