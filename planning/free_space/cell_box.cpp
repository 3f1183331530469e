#include "planning/free_space/cell_box.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

/// Appends `box` minus `hole` to `pieces`, as up to six boxes.
void cutOut(const CellBox& box, const CellBox& hole, std::vector<CellBox>& pieces) {
    CellBox rest = box;
    if (!overlap(box, hole)) {
        pieces.push_back(rest);
        return;
    }
    for (unsigned k = 0; k < 3; ++k) {
        if (rest.begin[k] < hole.begin[k]) {
            pieces.push_back(rest);
            pieces.back().end[k] = hole.begin[k];
            rest.begin[k] = hole.begin[k];
        }
        if (rest.end[k] > hole.end[k]) {
            pieces.push_back(rest);
            pieces.back().begin[k] = hole.end[k];
            rest.end[k] = hole.end[k];
        }
    }
}

/// Bounding box of rows of cells.
class Extent {
  public:
    void add(int x_begin, int x_end, int y, int z) {
        const std::array<int, 3> low = {x_begin, y, z};
        const std::array<int, 3> high = {x_end, y + 1, z + 1};
        for (unsigned k = 0; k < 3; ++k) {
            box_.begin[k] = any_ ? std::min(box_.begin[k], low[k]) : low[k];
            box_.end[k] = any_ ? std::max(box_.end[k], high[k]) : high[k];
        }
        any_ = true;
    }
    [[nodiscard]] const CellBox& box() const { return box_; }  // empty until a row is added

  private:
    CellBox box_;
    bool any_ = false;
};

}  // namespace

bool overlap(const CellBox& a, const CellBox& b) {
    if (a.empty() || b.empty()) return false;
    for (unsigned k = 0; k < 3; ++k) {
        if (a.end[k] <= b.begin[k] || b.end[k] <= a.begin[k]) return false;
    }
    return true;
}

CellBox wholeGrid(const VoxelGrid& grid) {
    return {{0, 0, 0}, grid.count};
}

CellBox cellsAround(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_in_cells) {
    CellBox cells;
    if (box_in_cells.isEmpty()) return cells;
    for (unsigned k = 0; k < 3; ++k) {
        const double most = grid.count[k];
        cells.begin[k] =
            static_cast<int>(std::clamp(std::floor(box_in_cells.min()[k]) - 1.0, 0.0, most));
        cells.end[k] =
            static_cast<int>(std::clamp(std::floor(box_in_cells.max()[k]) + 2.0, 0.0, most));
    }
    return cells;
}

CellBox grown(const CellBox& box, int cells, const VoxelGrid& grid) {
    if (box.empty()) return box;
    CellBox larger;
    for (unsigned k = 0; k < 3; ++k) {
        larger.begin[k] = std::max(box.begin[k] - cells, 0);
        larger.end[k] = std::min(box.end[k] + cells, grid.count[k]);
    }
    return larger;
}

std::vector<CellBox> apart(const std::vector<CellBox>& boxes) {
    std::vector<CellBox> all;
    for (const CellBox& box : boxes) {
        if (box.empty()) continue;
        std::vector<CellBox> rest = {box};
        for (std::size_t i = 0, count = all.size(); i < count && !rest.empty(); ++i) {
            std::vector<CellBox> pieces;
            for (const CellBox& part : rest) cutOut(part, all[i], pieces);
            rest.swap(pieces);
        }
        all.insert(all.end(), rest.begin(), rest.end());
    }
    return all;
}

CellBox changedIn(const CellBox& box, const VoxelGrid& grid, const std::vector<std::uint8_t>& a,
                  const std::vector<std::uint8_t>& b) {
    Extent changed;
    visitRows(box, grid, [&](std::size_t begin, std::size_t end, int x, int y, int z) {
        const auto first = a.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = a.begin() + static_cast<std::ptrdiff_t>(end);
        const auto other = b.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto from = std::mismatch(first, last, other).first;
        if (from == last) return;
        auto to = last;
        while (*(to - 1) == *(other + (to - 1 - first))) --to;
        changed.add(x + static_cast<int>(from - first), x + static_cast<int>(to - first), y, z);
    });
    return changed.box();
}

std::vector<CellBox> changedBoxes(const std::vector<CellBox>& likely, const VoxelGrid& grid,
                                  const std::vector<std::uint8_t>& a,
                                  const std::vector<std::uint8_t>& b) {
    std::vector<CellBox> boxes;
    for (const CellBox& box : likely) {
        const CellBox changed = changedIn(box, grid, a, b);
        if (!changed.empty()) boxes.push_back(changed);
    }
    Extent others;
    visitRows(wholeGrid(grid), grid, [&](std::size_t begin, std::size_t end, int x, int y, int z) {
        const auto first = a.begin() + static_cast<std::ptrdiff_t>(begin);
        if (std::equal(first, a.begin() + static_cast<std::ptrdiff_t>(end),
                       b.begin() + static_cast<std::ptrdiff_t>(begin))) {
            return;
        }
        for (std::size_t i = begin; i < end; ++i, ++x) {
            if (a[i] == b[i]) continue;
            const bool known = std::ranges::any_of(
                boxes, [&](const CellBox& box) { return box.contains(x, y, z); });
            if (!known) others.add(x, x + 1, y, z);
        }
    });
    if (!others.box().empty()) boxes.push_back(others.box());
    return boxes;
}

}  // namespace dollytrack::planning
