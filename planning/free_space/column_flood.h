#pragma once

#include "planning/free_space/floor_plan.h"
#include "planning/free_space/voxel_grid.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace dollytrack::planning {

/// Breadth-first flood fill over the columns of a plan: spreads the values of the columns in
/// `front` to 4-connected neighbours with value kNoPart, where `may(from, to)` returns true. If
/// several neighbours could give a column its value, the first one in the front does.
template <class May>
void floodFrom(std::vector<std::size_t> front, const VoxelGrid& plane, std::vector<int>& values,
               May&& may) {
    const std::size_t nx = plane.count[0];
    while (!front.empty()) {
        std::vector<std::size_t> next;
        for (const std::size_t from : front) {
            const std::size_t x = from % nx;
            const auto visit = [&](bool exists, std::size_t to) {
                if (!exists || values[to] != kNoPart || !may(from, to)) return;
                values[to] = values[from];
                next.push_back(to);
            };
            visit(x > 0, from - 1);
            visit(x + 1 < nx, from + 1);
            visit(from >= nx, from - nx);
            visit(from + nx < values.size(), from + nx);
        }
        front.swap(next);
    }
}

/// Flood fill from all columns that have a value: every other column gets the value of the nearest
/// one, along paths of columns for which `may(to)` returns true.
template <class May>
void spread(const VoxelGrid& plane, std::vector<int>& values, May&& may) {
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] != kNoPart) front.push_back(i);
    }
    floodFrom(std::move(front), plane, values,
              [&](std::size_t, std::size_t to) { return may(to); });
}

}  // namespace dollytrack::planning
