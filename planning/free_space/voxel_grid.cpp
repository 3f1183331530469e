#include "planning/free_space/voxel_grid.h"

#include <cmath>

namespace dollytrack::planning {
namespace {

VoxelGrid gridAround(const Eigen::AlignedBox3d& bounds, double resolution_m) {
    // A surface exactly on the border of two cells belongs to both, so the rim starts slightly
    // outside the bounds.
    constexpr double kHair = 1e-3;
    VoxelGrid grid;
    grid.resolution_m = resolution_m;
    for (unsigned k = 0; k < 3; ++k) {
        const double low = bounds.min()[k] / resolution_m;
        const double high = bounds.max()[k] / resolution_m;
        const int first = static_cast<int>(std::floor(low - kHair)) - 1;
        const int last = static_cast<int>(std::floor(high + kHair)) + 1;
        grid.first[k] = first;
        grid.count[k] = last - first + 1;
        grid.room_begin[k] = static_cast<int>(std::ceil(low - 0.5 - kHair)) - first;
        grid.room_end[k] = static_cast<int>(std::floor(high - 0.5 + kHair)) - first + 1;
    }
    return grid;
}

}  // namespace

VoxelGrid makeVoxelGrid(const Eigen::AlignedBox3d& bounds, double resolution_m,
                        std::size_t max_cells) {
    const auto cells = [&](double resolution) {
        return ((bounds.sizes() / resolution).array() + 4.0).prod();
    };
    double resolution = resolution_m;
    while (cells(resolution) > static_cast<double>(max_cells)) resolution *= 1.25;
    return gridAround(bounds, resolution);
}

}  // namespace dollytrack::planning
