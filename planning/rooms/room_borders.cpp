#include "planning/rooms/room_borders.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/column_flood.h"
#include "planning/free_space/floor_heights.h"
#include "planning/free_space/floor_plan.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <map>
#include <utility>

namespace dollytrack::planning {
namespace {

// Largest height of the camera's centre above the floor: above thresholds and rugs, below window
// sills.
constexpr double kWalks_m = 0.5;

/// Coordinates of a column, in columns.
Eigen::Vector2d placeOf(std::size_t column, const VoxelGrid& plane) {
    const int i = static_cast<int>(column);
    return {i % plane.count[0], i / plane.count[0]};
}

/// Splits the borders of a plan into connected parts.
class Borders {
  public:
    Borders(const VoxelGrid& plane, const std::vector<int>& parts, const FreeColumns& free_columns)
        : plane_(plane), parts_(parts), free_columns_(free_columns) {}

    [[nodiscard]] std::vector<RoomBorder> find() const {
        std::map<std::pair<int, int>, std::map<std::size_t, Eigen::Vector2d>> touching;
        const int nx = plane_.count[0];
        const int ny = plane_.count[1];
        for (int y = 0; y < ny; ++y) {
            for (int x = 0; x < nx; ++x) {
                if (x + 1 < nx) touch(x, y, x + 1, y, touching);
                if (y + 1 < ny) touch(x, y, x, y + 1, touching);
            }
        }
        std::vector<RoomBorder> borders;
        for (auto& [pair, columns] : touching) {
            while (!columns.empty()) borders.push_back(takeConnected(pair, columns));
        }
        return borders;
    }

  private:
    using Columns = std::map<std::size_t, Eigen::Vector2d>;

    void touch(int x, int y, int to_x, int to_y,
               std::map<std::pair<int, int>, Columns>& touching) const {
        const std::size_t from = plane_.indexOf(x, y, 0);
        const std::size_t to = plane_.indexOf(to_x, to_y, 0);
        const int a = parts_[from];
        const int b = parts_[to];
        if (a == b || a == kNoPart || b == kNoPart) return;
        if (free_columns_.walks[from] == 0 || free_columns_.walks[to] == 0) return;
        const Eigen::Vector2d step(to_x - x, to_y - y);
        if (a < b) {
            touching[{a, b}].try_emplace(from, Eigen::Vector2d::Zero()).first->second += step;
        } else {
            touching[{b, a}].try_emplace(to, Eigen::Vector2d::Zero()).first->second -= step;
        }
    }

    RoomBorder takeConnected(const std::pair<int, int>& pair, Columns& columns) const {
        RoomBorder border{pair.first, pair.second, {}, Eigen::Vector2d::Zero()};
        const int nx = plane_.count[0];
        std::vector<std::size_t> front = {columns.begin()->first};
        border.through += columns.begin()->second;
        columns.erase(columns.begin());
        while (!front.empty()) {
            const std::size_t at = front.back();
            front.pop_back();
            border.columns.push_back(at);
            const int x = static_cast<int>(at) % nx;
            const int y = static_cast<int>(at) / nx;
            // Two columns: thin posts and rounding do not split a border.
            for (int dy = -2; dy <= 2; ++dy) {
                for (int dx = -2; dx <= 2; ++dx) {
                    if (x + dx < 0 || x + dx >= nx || y + dy < 0 || y + dy >= plane_.count[1]) {
                        continue;
                    }
                    const auto found = columns.find(plane_.indexOf(x + dx, y + dy, 0));
                    if (found == columns.end()) continue;
                    border.through += found->second;
                    front.push_back(found->first);
                    columns.erase(found);
                }
            }
        }
        std::sort(border.columns.begin(), border.columns.end());
        return border;
    }

    const VoxelGrid& plane_;
    const std::vector<int>& parts_;
    const FreeColumns& free_columns_;
};

}  // namespace

FreeColumns freeColumnsOver(const VoxelGrid& grid, const std::vector<int>& part_of_column,
                            const FreeSpace& free_space, const FloorHeights& floors) {
    const std::size_t columns =
        static_cast<std::size_t>(grid.count[0]) * static_cast<std::size_t>(grid.count[1]);
    FreeColumns free_columns;
    free_columns.fits.assign(columns, 0);
    free_columns.walks.assign(columns, 0);
    free_columns.low.assign(columns, 0.0);
    free_columns.high.assign(columns, 0.0);
    parallelFor(columns, [&](std::size_t i) {
        const int column = static_cast<int>(i);
        const auto at = [&](int z) {
            return grid.centerOf(column % grid.count[0], column / grid.count[0], z);
        };
        int low = 0;
        int high = grid.count[2] - 1;
        while (low <= high && free_space.componentAt(at(low)) < 0) ++low;
        while (high > low && free_space.componentAt(at(high)) < 0) --high;
        if (low > high) return;
        free_columns.fits[i] = 1;
        free_columns.low[i] = at(low).z();
        free_columns.high[i] = at(high).z();
        if (part_of_column[i] == kNoPart) return;
        free_columns.walks[i] = free_columns.low[i] - floors.below(at(low)) <= kWalks_m ? 1 : 0;
    });
    // In wall columns use the floor beside the wall: the top of a parapet is not a floor.
    std::vector<int> nearest(columns, kNoPart);
    for (std::size_t i = 0; i < columns; ++i) {
        if (free_columns.walks[i] != 0) nearest[i] = static_cast<int>(i);
    }
    spread(grid, nearest, [](std::size_t) { return true; });
    for (std::size_t i = 0; i < columns; ++i) {
        if (part_of_column[i] != kNoPart || free_columns.fits[i] == 0 || nearest[i] == kNoPart)
            continue;
        const double beside = free_columns.low[nearest[i]];
        free_columns.walks[i] = free_columns.low[i] - beside <= kWalks_m ? 1 : 0;
    }
    return free_columns;
}

std::vector<RoomBorder> findBorders(const VoxelGrid& plane, const std::vector<int>& part_of_column,
                                    const FreeColumns& free_columns) {
    return Borders(plane, part_of_column, free_columns).find();
}

double widthOf(const RoomBorder& border, const VoxelGrid& plane) {
    double widest = 0.0;
    for (const std::size_t a : border.columns) {
        for (const std::size_t b : border.columns) {
            widest = std::max(widest, (placeOf(a, plane) - placeOf(b, plane)).norm());
        }
    }
    return (widest + 1.0) * plane.resolution_m;
}

std::size_t middleOf(const RoomBorder& border, const VoxelGrid& plane) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const std::size_t i : border.columns) sum += placeOf(i, plane);
    const Eigen::Vector2d middle = sum / static_cast<double>(border.columns.size());
    return *std::min_element(
        border.columns.begin(), border.columns.end(), [&](std::size_t a, std::size_t b) {
            return (placeOf(a, plane) - middle).norm() < (placeOf(b, plane) - middle).norm();
        });
}

}  // namespace dollytrack::planning
