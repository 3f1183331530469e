#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace dollytrack::ui {

/// An axis-aligned slab of the map.
struct Slice {
    int axis = 2;  // 0: x, 1: y, 2: z
    double position_m = 1.2;
    double thickness_m = 0.05;
    bool operator==(const Slice&) const = default;
};

/// A slice as a range of cell indices counted from the world's origin; `end` is exclusive. It has
/// at least one cell and contains the cell at the slice's position.
struct CellRange {
    std::int64_t begin = 0;
    std::int64_t end = 0;
};

[[nodiscard]] inline CellRange cellsOf(const Slice& slice, double cell_m) {
    const auto middle = static_cast<std::int64_t>(std::floor(slice.position_m / cell_m));
    const std::int64_t count = std::max<std::int64_t>(1, std::llround(slice.thickness_m / cell_m));
    return {middle - (count - 1) / 2, middle - (count - 1) / 2 + count};
}

}  // namespace dollytrack::ui
