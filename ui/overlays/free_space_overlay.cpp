#include "ui/overlays/free_space_overlay.h"

#include "ui/overlays/palette.h"
#include "ui/overlays/picking.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dollytrack::ui {
namespace {

using planning::CellState;
using planning::FreeSpace;
using planning::FreeSpaceLeaf;

const Eigen::Vector4f kFree(0.20F, 0.68F, 0.42F, 1.0F);
const Eigen::Vector4f kOccupied(0.86F, 0.36F, 0.22F, 1.0F);
const Eigen::Vector4f kUnknown(0.42F, 0.44F, 0.50F, 1.0F);
constexpr int kBands = 16;         // clearance bands, one colour each
constexpr double kPieceCells = 4;  // edge of the boxes that show clearance
constexpr int kUnknownLevel = 8;   // level of the largest boxes of unknown space

constexpr int kMostLevels = 17;

/// The colour scale spans seven levels, as many as maps of a few metres have.
Eigen::Vector4f levelColor(int level) {
    return scaleColor(std::min(level / 6.0, 1.0));
}

/// A box of cells, counted from the world's origin; `high` is exclusive.
struct CellBlock {
    std::array<std::int64_t, 3> low{};
    std::array<std::int64_t, 3> high{};

    [[nodiscard]] bool empty() const {
        return low[0] >= high[0] || low[1] >= high[1] || low[2] >= high[2];
    }
    [[nodiscard]] CellBlock cut(const CellBlock& other) const {
        CellBlock result;
        for (std::size_t k = 0; k < 3; ++k) {
            result.low[k] = std::max(low[k], other.low[k]);
            result.high[k] = std::min(high[k], other.high[k]);
        }
        return result;
    }
};

bool shows(const FreeSpaceOverlayOptions& options, CellState state) {
    switch (state) {
        case CellState::Free:
            return options.free;
        case CellState::Occupied:
            return options.occupied;
        case CellState::Unknown:
            return options.unknown && options.slice.has_value();
    }
    return false;
}

bool inLevels(const FreeSpaceOverlayOptions& options, int level) {
    return level >= options.min_level && level <= options.max_level;
}

class FreeSpaceBuilder {
  public:
    FreeSpaceBuilder(const FreeSpace& free_space, const FreeSpaceOverlayOptions& options)
        : map_(free_space), options_(options), cell_m_(free_space.resolution_m()) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            region_.low[k] = std::llround(map_.bounds().min()[axis] / cell_m_);
            region_.high[k] = std::llround(map_.bounds().max()[axis] / cell_m_);
        }
        if (options.slice) {
            const CellRange range = cellsOf(*options.slice, cell_m_);
            const std::size_t k = options.slice->axis;
            region_.low[k] = std::max(region_.low[k], range.begin);
            region_.high[k] = std::min(region_.high[k], range.end);
        }
    }

    PlanLayer build() {
        if (!region_.empty()) {
            map_.visitLeaves([this](const FreeSpaceLeaf& leaf) { addLeaf(leaf); });
            if (shows(options_, CellState::Unknown)) addUnknown();
        }
        if (options_.color == CellColor::Clearance) colorByClearance();
        describe();
        return std::move(layer_);
    }

  private:
    void addLeaf(const FreeSpaceLeaf& leaf) {
        if (!shows(options_, leaf.state) || !inLevels(options_, leaf.level)) return;
        CellBlock block;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            block.low[k] = std::llround((leaf.center[axis] - 0.5 * leaf.size_m) / cell_m_);
            block.high[k] = std::llround((leaf.center[axis] + 0.5 * leaf.size_m) / cell_m_);
        }
        block = block.cut(region_);
        if (block.empty()) return;
        ++count_[static_cast<std::size_t>(leaf.state)];
        const bool in_pieces = options_.color == CellColor::Clearance && options_.slice &&
                               leaf.state == CellState::Free;
        if (in_pieces) {
            addPieces(block);
        } else {
            add(block, leaf.state, leaf.level);
        }
    }

    void addPieces(const CellBlock& block) {
        constexpr auto kStep = static_cast<std::int64_t>(kPieceCells);
        for (std::int64_t z = block.low[2]; z < block.high[2]; z += kStep) {
            for (std::int64_t y = block.low[1]; y < block.high[1]; y += kStep) {
                for (std::int64_t x = block.low[0]; x < block.high[0]; x += kStep) {
                    const CellBlock piece{{x, y, z}, {x + kStep, y + kStep, z + kStep}};
                    add(piece.cut(block), CellState::Free);
                }
            }
        }
    }

    void add(const CellBlock& block, CellState state, int level = 0) {
        render::OverlayBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            box.center[axis] = 0.5 * cell_m_ * static_cast<double>(block.low[k] + block.high[k]);
            box.half_size[axis] = 0.5 * cell_m_ * static_cast<double>(block.high[k] - block.low[k]);
        }
        box.rgba = colorOf(state, box.center, level);
        layer_.overlay.boxes.push_back(box);
        if (options_.color == CellColor::Clearance) {
            clearance_.push_back(state == CellState::Free ? map_.clearanceLowerBound(box.center)
                                                          : -1.0);
        }
    }

    [[nodiscard]] Eigen::Vector4f colorOf(CellState state, const Eigen::Vector3d& center,
                                          int level) {
        if (state == CellState::Occupied) return withOpacity(kOccupied, options_.opacity);
        if (state == CellState::Unknown) return withOpacity(kUnknown, options_.opacity);
        if (options_.color == CellColor::Level) {
            const std::size_t at = std::clamp(level, 0, kMostLevels - 1);
            ++levels_[at];
            return withOpacity(levelColor(level), options_.opacity);
        }
        if (options_.color != CellColor::Component) return withOpacity(kFree, options_.opacity);
        const int room = map_.componentAt(center);
        if (room < 0) {
            ++no_room_;
            return withOpacity(kSpareColor, options_.opacity);
        }
        rooms_.resize(std::max(rooms_.size(), static_cast<std::size_t>(room) + 1));
        ++rooms_[room];
        return withOpacity(partColor(room), options_.opacity);
    }

    /// Adds the largest octree-aligned cubes whose part within the region is entirely unknown.
    void addUnknown() {
        const auto top = std::int64_t{1} << kUnknownLevel;
        std::array<std::int64_t, 3> first{};
        for (std::size_t k = 0; k < 3; ++k) {
            // The shift rounds towards minus infinity, also for negative numbers.
            first[k] = region_.low[k] >> kUnknownLevel << kUnknownLevel;
        }
        for (std::int64_t z = first[2]; z < region_.high[2]; z += top) {
            for (std::int64_t y = first[1]; y < region_.high[1]; y += top) {
                for (std::int64_t x = first[0]; x < region_.high[0]; x += top) {
                    addUnknown({x, y, z}, kUnknownLevel);
                }
            }
        }
    }

    void addUnknown(const std::array<std::int64_t, 3>& low, int level) {
        const auto size = std::int64_t{1} << level;
        const CellBlock block =
            CellBlock{low, {low[0] + size, low[1] + size, low[2] + size}}.cut(region_);
        if (block.empty()) return;
        if (isUnknown(block)) {
            if (!inLevels(options_, level)) return;
            ++count_[static_cast<std::size_t>(CellState::Unknown)];
            add(block, CellState::Unknown);
            return;
        }
        if (level == 0) return;
        for (std::int64_t child = 0; child < 8; ++child) {
            const std::int64_t half = size / 2;
            addUnknown({low[0] + (child & 1) * half, low[1] + (child >> 1 & 1) * half,
                        low[2] + (child >> 2 & 1) * half},
                       level - 1);
        }
    }

    [[nodiscard]] bool isUnknown(const CellBlock& block) const {
        for (std::int64_t z = block.low[2]; z < block.high[2]; ++z) {
            for (std::int64_t y = block.low[1]; y < block.high[1]; ++y) {
                for (std::int64_t x = block.low[0]; x < block.high[0]; ++x) {
                    const Eigen::Vector3d center =
                        cell_m_ * Eigen::Vector3d(static_cast<double>(x) + 0.5,
                                                  static_cast<double>(y) + 0.5,
                                                  static_cast<double>(z) + 0.5);
                    if (map_.stateAt(center) != CellState::Unknown) return false;
                }
            }
        }
        return true;
    }

    void colorByClearance() {
        double most = 0.0;
        for (const double clearance : clearance_) most = std::max(most, clearance);
        for (std::size_t i = 0; i < clearance_.size(); ++i) {
            if (clearance_[i] < 0.0) continue;
            const double band =
                most > 0.0 ? std::min(std::floor(kBands * clearance_[i] / most), kBands - 1.0)
                           : 0.0;
            layer_.overlay.boxes[i].rgba =
                withOpacity(scaleColor(band / (kBands - 1.0)), options_.opacity);
        }
        if (options_.free) layer_.legend.scale = LegendScale{"Clearance", "m", 0.0, most};
    }

    void describe() {
        using Shape = LegendEntry::Shape;
        Legend& legend = layer_.legend;
        legend.title = options_.slice ? "Space, sliced" : "Space";
        const auto count = [&](CellState state) { return count_[static_cast<std::size_t>(state)]; };
        if (options_.free && options_.color == CellColor::State) {
            legend.entries.push_back({"Free", Shape::Block, kFree, count(CellState::Free)});
        }
        if (options_.free && options_.color == CellColor::Component) {
            for (std::size_t room = 0; room < rooms_.size(); ++room) {
                if (rooms_[room] == 0) continue;
                legend.entries.push_back({"Room " + std::to_string(room + 1), Shape::Block,
                                          partColor(static_cast<int>(room)), rooms_[room]});
            }
            legend.entries.push_back(
                {"Free, too narrow for the camera", Shape::Block, kSpareColor, no_room_});
        }
        if (options_.free && options_.color == CellColor::Level) {
            for (int level = 0; level < kMostLevels; ++level) {
                const int number = levels_[level];
                if (number == 0) continue;
                legend.entries.push_back(
                    {fmt::format("Free, level {}: {:.2f} m", level, cell_m_ * std::exp2(level)),
                     Shape::Block, levelColor(level), number});
            }
        }
        if (options_.occupied) {
            legend.entries.push_back(
                {"Occupied", Shape::Block, kOccupied, count(CellState::Occupied)});
        }
        if (shows(options_, CellState::Unknown)) {
            legend.entries.push_back(
                {"Unknown", Shape::Block, kUnknown, count(CellState::Unknown)});
        }
    }

    const FreeSpace& map_;
    const FreeSpaceOverlayOptions& options_;
    double cell_m_;
    CellBlock region_;
    PlanLayer layer_;
    std::vector<double> clearance_;  // by box; -1: not free
    std::array<int, 3> count_{};     // number of leaves, by state
    std::vector<int> rooms_;
    std::array<int, kMostLevels> levels_{};
    int no_room_ = 0;
};

}  // namespace

PlanLayer freeSpaceLayer(const FreeSpace& free_space, const FreeSpaceOverlayOptions& options) {
    return FreeSpaceBuilder(free_space, options).build();
}

std::optional<Voxel> voxelAt(const FreeSpace& free_space, const render::View& view,
                             const Eigen::Vector2d& pixel, const FreeSpaceOverlayOptions& options) {
    const double cell_m = free_space.resolution_m();
    Eigen::AlignedBox3d region = free_space.bounds();
    if (options.slice) {
        const CellRange range = cellsOf(*options.slice, cell_m);
        const int axis = options.slice->axis;
        region.min()[axis] =
            std::max(region.min()[axis], cell_m * static_cast<double>(range.begin));
        region.max()[axis] = std::min(region.max()[axis], cell_m * static_cast<double>(range.end));
    }
    if (view.clip_box) region = region.intersection(*view.clip_box);
    const render::ViewRay ray = view.rayThrough(pixel.x(), pixel.y());
    const auto [enter, leave] = partInBox(region, ray.origin, ray.direction,
                                          {view.near_m, std::numeric_limits<double>::infinity()});
    // Steps along the ray from cell to cell, just past each cell border.
    const double nudge = 1e-6 * cell_m / ray.direction.norm();
    for (double t = enter + nudge; t < leave;) {
        const Eigen::Vector3d point = ray.origin + t * ray.direction;
        Voxel voxel;
        double next = leave;
        for (int k = 0; k < 3; ++k) {
            const double cell = std::floor(point[k] / cell_m);
            voxel.center[k] = (cell + 0.5) * cell_m;
            if (ray.direction[k] == 0.0) continue;
            const double border = (cell + (ray.direction[k] > 0.0 ? 1.0 : 0.0)) * cell_m;
            next = std::min(next, (border - ray.origin[k]) / ray.direction[k]);
        }
        voxel.state = free_space.stateAt(voxel.center);
        voxel.leaf_size_m = free_space.cellSizeAt(voxel.center);
        const int level = static_cast<int>(std::lround(std::log2(voxel.leaf_size_m / cell_m)));
        const bool in_levels = voxel.state == CellState::Unknown || inLevels(options, level);
        if (shows(options, voxel.state) && in_levels) {
            voxel.clearance_m = free_space.clearanceLowerBound(voxel.center);
            voxel.component = free_space.componentAt(voxel.center);
            return voxel;
        }
        t = std::max(next, t) + nudge;
    }
    return std::nullopt;
}

}  // namespace dollytrack::ui
