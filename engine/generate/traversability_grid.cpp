#include "engine/generate/traversability_grid.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::generate {
namespace {

using Eigen::Vector2d;

constexpr double kCell = 10.0;              // cm
constexpr double kReach = 25.0;             // half the width that a camera needs
constexpr std::size_t kNiche = 12;          // largest number of unconnected cells
constexpr std::size_t kLeastShareInv = 12;  // at least a twelfth of the floor stays free

/// Numbers the connected components of the free cells from 1. Returns their sizes in cells, by
/// number.
std::vector<std::size_t> joinedParts(const std::vector<bool>& open, int columns, int rows,
                                     std::vector<int>& part_of) {
    std::vector<std::size_t> sizes = {0};
    std::vector<int> stack;
    part_of.assign(open.size(), 0);
    for (int start = 0; start < columns * rows; ++start) {
        const auto enter = [&](int cell) {
            const std::size_t index = cell;
            if (!open[index] || part_of[index] != 0) return;
            part_of[index] = static_cast<int>(sizes.size()) - 1;
            stack.push_back(cell);
        };
        const std::size_t first = start;
        if (!open[first] || part_of[first] != 0) continue;
        sizes.push_back(0);
        enter(start);
        while (!stack.empty()) {
            const int cell = stack.back();
            stack.pop_back();
            ++sizes.back();
            const int column = cell % columns;
            if (column > 0) enter(cell - 1);
            if (column + 1 < columns) enter(cell + 1);
            if (cell >= columns) enter(cell - columns);
            if (cell + columns < columns * rows) enter(cell + columns);
        }
    }
    return sizes;
}

}  // namespace

TraversabilityGrid::TraversabilityGrid(double length, double width)
    : columns_(std::max(1, static_cast<int>(length / kCell))),
      rows_(std::max(1, static_cast<int>(width / kCell))),
      open_(static_cast<std::size_t>(columns_ * rows_), true) {
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            const Vector2d at((column + 0.5) * kCell, (row + 0.5) * kCell);
            const double wall =
                std::min(std::min(at.x(), length - at.x()), std::min(at.y(), width - at.y()));
            if (wall < kReach) open_[row * columns_ + column] = false;
        }
    }
}

std::size_t TraversabilityGrid::cellAt(const Vector2d& point) const {
    const int column = std::clamp(static_cast<int>(point.x() / kCell), 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(point.y() / kCell), 0, rows_ - 1);
    return static_cast<std::size_t>(row * columns_ + column);
}

void TraversabilityGrid::close(const UprightBox& box, std::vector<bool>& open) const {
    UprightBox camera;
    camera.half = {kReach, kReach};
    camera.high = box.high;
    const Vector2d reach =
        Vector2d(reachAlong(box, Vector2d::UnitX()), reachAlong(box, Vector2d::UnitY())) +
        Vector2d::Constant(kReach + kCell);
    const auto lowest = cellAt(box.centre - reach);
    const auto highest = cellAt(box.centre + reach);
    const int columns = columns_;
    const int first = static_cast<int>(lowest) % columns;
    const int last = static_cast<int>(highest) % columns;
    for (int row = static_cast<int>(lowest) / columns; row <= static_cast<int>(highest) / columns;
         ++row) {
        for (int column = first; column <= last; ++column) {
            camera.centre = {(column + 0.5) * kCell, (row + 0.5) * kCell};
            if (near(camera, box, 0.0)) open[row * columns + column] = false;
        }
    }
}

bool TraversabilityGrid::staysConnectedWith(const UprightBox& box) const {
    std::vector<bool> open = open_;
    close(box, open);
    std::vector<int> part_of;
    const std::vector<std::size_t> sizes = joinedParts(open, columns_, rows_, part_of);
    const auto largest = std::max_element(sizes.begin(), sizes.end());
    std::size_t total = 0;
    for (const std::size_t size : sizes) total += size;
    if (*largest < open.size() / kLeastShareInv || total - *largest > kNiche) return false;
    const int main_part = static_cast<int>(largest - sizes.begin());
    return std::all_of(entrances_.begin(), entrances_.end(), [&](const Vector2d& entrance) {
        return part_of[cellAt(entrance)] == main_part;
    });
}

}  // namespace dollytrack::generate
