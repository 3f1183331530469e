#include "planning/free_space/components.h"

#include "engine/core/disjoint_sets.h"
#include "engine/jobs/parallel.h"

#include <numeric>

namespace dollytrack::planning {
namespace {

using RunSets = DisjointSets<std::uint32_t>;

/// Joins the runs of two neighbouring rows, each given as a range of run numbers.
void joinRows(const std::vector<CellRun>& runs, std::size_t a, std::size_t a_end, std::size_t b,
              std::size_t b_end, RunSets& sets) {
    while (a < a_end && b < b_end) {
        if (runs[a].x_begin < runs[b].x_end && runs[b].x_begin < runs[a].x_end) {
            sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
        }
        if (runs[a].x_end < runs[b].x_end) {
            ++a;
        } else {
            ++b;
        }
    }
}

}  // namespace

CellComponents findComponents(const VoxelGrid& grid, const std::vector<std::uint8_t>& cells,
                              std::uint8_t mask) {
    const auto [nx, ny, nz] = grid.count;
    std::vector<std::vector<CellRun>> slices(nz);
    parallelFor(slices.size(), [&, nx = nx, ny = ny](std::size_t z) {
        for (int y = 0; y < ny; ++y) {
            const std::uint8_t* row = cells.data() + grid.rowOf(y, static_cast<int>(z));
            for (int x = 0; x < nx;) {
                if ((row[x] & mask) == 0) {
                    ++x;
                    continue;
                }
                const int begin = x;
                while (x < nx && (row[x] & mask) != 0) ++x;
                slices[z].push_back({begin, x, y, static_cast<int>(z), 0});
            }
        }
    });

    CellComponents result;
    std::size_t total = 0;
    for (const auto& slice : slices) total += slice.size();
    result.runs.reserve(total);
    const std::size_t rows = static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
    std::vector<std::size_t> row_begin(rows + 1, 0);
    for (const auto& slice : slices) {
        for (const CellRun& run : slice) {
            ++row_begin[static_cast<std::size_t>(run.z) * static_cast<std::size_t>(ny) +
                        static_cast<std::size_t>(run.y) + 1];
        }
        result.runs.insert(result.runs.end(), slice.begin(), slice.end());
    }
    std::partial_sum(row_begin.begin(), row_begin.end(), row_begin.begin());

    RunSets sets(total);
    const std::size_t step_z = ny;
    for (std::size_t row = 0; row < rows; ++row) {
        if (row % step_z != 0) {
            joinRows(result.runs, row_begin[row - 1], row_begin[row], row_begin[row],
                     row_begin[row + 1], sets);
        }
        if (row >= step_z) {
            joinRows(result.runs, row_begin[row - step_z], row_begin[row - step_z + 1],
                     row_begin[row], row_begin[row + 1], sets);
        }
    }
    for (std::size_t i = 0; i < total; ++i) {
        CellRun& run = result.runs[i];
        // A root is its component's first run, so the components are numbered in order.
        const std::uint32_t root = sets.find(static_cast<std::uint32_t>(i));
        if (root == i) {
            run.component = static_cast<int>(result.cells.size());
            result.cells.push_back(0);
        } else {
            run.component = result.runs[root].component;
        }
        result.cells[run.component] += run.x_end - run.x_begin;
    }
    return result;
}

}  // namespace dollytrack::planning
