#include "planning/free_space/opening_report.h"

#include "planning/free_space/components.h"
#include "planning/free_space/octree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace dollytrack::planning {
namespace {

constexpr double kSmallestOpening_m2 = 0.1;
constexpr double kMostOfASide = 0.5;
// Free cells at an opening may be too close to its frame for the camera; their room is searched
// this many cells inwards.
constexpr int kInwardCells = 12;

// Bits of a cell: 0 to 5, an open face at the scene's box in one of six directions; 6, an open face
// elsewhere.
constexpr std::array<std::array<int, 3>, 6> kFaces = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
constexpr std::uint8_t kOpenInside = 1U << 6U;

struct OpenFaces {
    Eigen::Vector3d outwards = Eigen::Vector3d::Zero();  // sum of the faces' normals
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::int64_t cells = 0;
    int room = kNoRoom;
};

class Finder {
  public:
    Finder(const VoxelGrid& grid, const std::vector<std::uint8_t>& states, const FoundRooms& rooms)
        : grid_(grid), states_(states), rooms_(rooms), open_(grid.size(), 0) {
        for (int z = grid.room_begin[2]; z < grid.room_end[2]; ++z) {
            for (int y = grid.room_begin[1]; y < grid.room_end[1]; ++y) {
                for (int x = grid.room_begin[0]; x < grid.room_end[0]; ++x) markFaces(x, y, z);
            }
        }
    }

    void collect(std::uint8_t bit, std::vector<Opening>& openings) const {
        const CellComponents holes = findComponents(grid_, open_, bit);
        std::vector<OpenFaces> faces(holes.cells.size());
        for (const CellRun& run : holes.runs) {
            OpenFaces& hole = faces[run.component];
            for (int x = run.x_begin; x < run.x_end; ++x) addCell(x, run.y, run.z, bit, hole);
        }
        for (const OpenFaces& hole : faces) {
            if (hole.room == kNoRoom) continue;
            const Opening opening = openingFrom(hole, bit != kOpenInside);
            if (opening.area_m2 >= kSmallestOpening_m2) openings.push_back(opening);
        }
    }

  private:
    [[nodiscard]] bool isFree(std::size_t i) const {
        return (states_[i] & kCellStateMask) == kFreeCell;
    }

    /// 0: closed; 1: open at the scene's box; 2: open elsewhere.
    [[nodiscard]] int openness(int x, int y, int z, const std::array<int, 3>& face) const {
        const std::array<int, 3> to = {x + face[0], y + face[1], z + face[2]};
        const std::size_t i = grid_.indexOf(to[0], to[1], to[2]);
        if ((states_[i] & kCellStateMask) != kUnknownCell || rooms_.hollow[i] != 0) return 0;
        return grid_.inRoom(to[0], to[1], to[2]) ? 2 : 1;
    }

    void markFaces(int x, int y, int z) {
        const std::size_t i = grid_.indexOf(x, y, z);
        if (!isFree(i)) return;
        for (unsigned face = 0; face < kFaces.size(); ++face) {
            const int open = openness(x, y, z, kFaces[face]);
            if (open == 1) open_[i] |= static_cast<std::uint8_t>(1U << face);
            if (open == 2) open_[i] |= kOpenInside;
        }
    }

    void addCell(int x, int y, int z, std::uint8_t bit, OpenFaces& hole) const {
        hole.sum += grid_.centerOf(x, y, z);
        ++hole.cells;
        for (unsigned face = 0; face < kFaces.size(); ++face) {
            const bool counts =
                bit == kOpenInside ? openness(x, y, z, kFaces[face]) == 2 : bit == (1U << face);
            if (!counts) continue;
            const auto& [dx, dy, dz] = kFaces[face];
            hole.outwards += Eigen::Vector3d(dx, dy, dz);
            for (int i = 0; i < kInwardCells && hole.room == kNoRoom; ++i) {
                const std::size_t at = grid_.indexOf(x - i * dx, y - i * dy, z - i * dz);
                if (!isFree(at)) break;
                hole.room = rooms_.room_of_cell[at];
            }
        }
    }

    [[nodiscard]] Opening openingFrom(const OpenFaces& hole, bool at_box) const {
        const double cell_area = grid_.resolution_m * grid_.resolution_m;
        Eigen::Index axis = 0;
        const double area = hole.outwards.cwiseAbs().maxCoeff(&axis) * cell_area;
        Opening opening;
        opening.component = hole.room;
        opening.outwards = Eigen::Vector3d::Zero();
        opening.outwards[axis] = hole.outwards[axis] < 0.0 ? -1.0 : 1.0;
        opening.center_in_world = hole.sum / static_cast<double>(hole.cells);
        opening.area_m2 = area;
        opening.at_scene_box = at_box;

        const FoundRoom& room = rooms_.rooms[hole.room];
        const auto extent = [&](unsigned k) {
            return (room.high[k] - room.low[k] + 1) * grid_.resolution_m;
        };
        const double side = axis == 2 ? static_cast<double>(room.columns) * cell_area
                                      : extent(2) * extent(axis == 0 ? 1U : 0U);
        if (area >= kMostOfASide * side) {
            opening.kind = axis != 2                  ? OpeningKind::MissingWall
                           : opening.outwards.z() > 0 ? OpeningKind::NoCeiling
                                                      : OpeningKind::NoFloor;
        }
        return opening;
    }

    const VoxelGrid& grid_;
    const std::vector<std::uint8_t>& states_;
    const FoundRooms& rooms_;
    std::vector<std::uint8_t> open_;
};

std::string sideName(const Eigen::Vector3d& outwards) {
    if (outwards.z() > 0.5) return "above (+z)";
    if (outwards.z() < -0.5) return "below (-z)";
    if (std::abs(outwards.x()) > 0.5) return outwards.x() > 0.0 ? "its +x side" : "its -x side";
    return outwards.y() > 0.0 ? "its +y side" : "its -y side";
}

}  // namespace

std::string describe(const Opening& opening) {
    std::string what;
    switch (opening.kind) {
        case OpeningKind::NoCeiling:
            what = "has no ceiling";
            break;
        case OpeningKind::NoFloor:
            what = "has no floor";
            break;
        case OpeningKind::MissingWall:
            what = "has no wall on " + sideName(opening.outwards);
            break;
        case OpeningKind::Hole:
            what = "is open towards " + sideName(opening.outwards);
            break;
    }
    const Eigen::Vector3d& at = opening.center_in_world;
    std::array<char, 160> text = {};
    std::snprintf(
        text.data(), text.size(), "Room %d %s (%.1f m2 around %.1f, %.1f, %.1f; %s)",
        opening.component + 1, what.c_str(), opening.area_m2, at.x(), at.y(), at.z(),
        opening.at_scene_box ? "at the edge of the scene" : "at the edge of the building");
    return text.data();
}

OpeningReport findOpenings(const VoxelGrid& grid, const std::vector<std::uint8_t>& states,
                           const FoundRooms& rooms) {
    OpeningReport report;
    const Finder finder(grid, states, rooms);
    for (unsigned face = 0; face < kFaces.size(); ++face) {
        finder.collect(static_cast<std::uint8_t>(1U << face), report.openings);
    }
    finder.collect(kOpenInside, report.openings);
    std::ranges::stable_sort(report.openings, [](const Opening& a, const Opening& b) {
        return a.component != b.component ? a.component < b.component : a.area_m2 > b.area_m2;
    });
    return report;
}

}  // namespace dollytrack::planning
