#include "planning/free_space/rooms.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/components.h"
#include "planning/free_space/distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace dollytrack::planning {
namespace {

// Least size of a room. Toilets and store rooms pass; shafts, cupboards and the gap between a sofa
// and the wall do not.
constexpr double kRoomVolume_m3 = 0.6;
constexpr double kRoomHeight_m = 1.0;
constexpr double kRoomGap_m = 0.3;  // from the roomiest cell to the nearest surface
// Smaller components are never a room, even if there is no larger one.
constexpr double kPocketVolume_m3 = 0.05;
// Components up to this volume may be inside furniture; larger ones are always rooms.
constexpr double kFurnitureVolume_m3 = 12.0;
// Share of rays from a component that hit one object if the component is inside that object.
constexpr double kOneObjectShare = 0.5;
constexpr double kStructureShare =
    0.15;  // of the rays that hit anything, or more: see kLeastHitShare
constexpr double kLeastHitShare = 0.125;  // smallest share of hits that kStructureShare is taken of
constexpr std::size_t kMaxRooms = 250;
// Smaller components are not tested for being inside furniture.
constexpr double kHollowVolume_m3 = 0.02;
constexpr int kRays = 512;        // for components of the size of a room
constexpr int kHollowRays = 128;  // for smaller components

/// Whether a surface touches a cell along the axes that lies wholly in the sphere around this
/// cell's centre. Close to walls and floors this avoids most exact distance queries.
class SurfaceInSphere {
  public:
    SurfaceInSphere(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces, double radius)
        : grid_(grid), surfaces_(surfaces) {
        // Distance to the far corner of the cell k steps away; cells are marked slightly enlarged.
        while ((steps_ + 1.5) * (steps_ + 1.5) + 0.5 < 0.998 * radius * radius) ++steps_;
    }

    [[nodiscard]] bool operator()(int x, int y, int z) const {
        for (int k = 1; k <= steps_; ++k) {
            if ((x >= k && at(x - k, y, z)) || (x + k < grid_.count[0] && at(x + k, y, z)) ||
                (y >= k && at(x, y - k, z)) || (y + k < grid_.count[1] && at(x, y + k, z)) ||
                (z >= k && at(x, y, z - k)) || (z + k < grid_.count[2] && at(x, y, z + k))) {
                return true;
            }
        }
        return false;
    }

  private:
    [[nodiscard]] bool at(int x, int y, int z) const {
        return surfaces_[grid_.indexOf(x, y, z)] != 0;
    }

    const VoxelGrid& grid_;
    const std::vector<std::uint8_t>& surfaces_;
    int steps_ = 0;
};

/// Tests whether the sphere fits at the centre of inside cells.
class SphereFit {
  public:
    explicit SphereFit(const SphereFitInput& input)
        : input_(input),
          radius_(input.camera_radius_m / input.grid.resolution_m),
          sure_(static_cast<std::uint16_t>(
              std::min<double>(std::ceil(radius_ * radius_), kMaxSquaredGap))),
          surface_in_sphere_(input.grid, input.surfaces, radius_) {}

    [[nodiscard]] std::uint8_t operator()(std::size_t i, int x, int y, int z) const {
        if (input_.inside[i] == 0) return 0;
        if (input_.squared_gaps[i] >= sure_) return 1;
        if (surface_in_sphere_(x, y, z)) return 0;
        return input_.rays.isClear(input_.grid.centerOf(x, y, z), input_.camera_radius_m) ? 1 : 0;
    }

  private:
    const SphereFitInput& input_;
    double radius_;       // in cells
    std::uint16_t sure_;  // a squared gap of at least this leaves room for the sphere
    SurfaceInSphere surface_in_sphere_;
};

std::vector<FoundRoom> measure(const VoxelGrid& grid, const CellComponents& pieces,
                               const std::vector<std::uint16_t>& squared_gaps) {
    std::vector<FoundRoom> rooms(pieces.cells.size());
    std::vector<int> best_gap(rooms.size(), -1);
    for (std::size_t i = 0; i < rooms.size(); ++i) {
        rooms[i].cells = pieces.cells[i];
        rooms[i].low.fill(std::numeric_limits<int>::max());
        rooms[i].high.fill(std::numeric_limits<int>::min());
    }
    for (const CellRun& run : pieces.runs) {
        const std::size_t index = run.component;
        FoundRoom& room = rooms[index];
        const std::array<int, 3> begin = {run.x_begin, run.y, run.z};
        const std::array<int, 3> end = {run.x_end - 1, run.y, run.z};
        for (unsigned k = 0; k < 3; ++k) {
            room.low[k] = std::min(room.low[k], begin[k]);
            room.high[k] = std::max(room.high[k], end[k]);
        }
        const std::uint16_t* gaps = squared_gaps.data() + grid.rowOf(run.y, run.z);
        for (int x = run.x_begin; x < run.x_end; ++x) {
            if (gaps[x] <= best_gap[index]) continue;
            best_gap[index] = gaps[x];
            room.roomiest = {x, run.y, run.z};
        }
    }
    return rooms;
}

double volumeOf(const FoundRoom& room, const VoxelGrid& grid) {
    return static_cast<double>(room.cells) * std::pow(grid.resolution_m, 3);
}

bool hasRoomSize(const FoundRoom& room, const VoxelGrid& grid,
                 const std::vector<std::uint16_t>& squared_gaps) {
    const auto& [x, y, z] = room.roomiest;
    const double gap = std::sqrt(squared_gaps[grid.indexOf(x, y, z)]) * grid.resolution_m;
    const double height = (room.high[2] - room.low[2] + 1) * grid.resolution_m;
    return volumeOf(room, grid) >= kRoomVolume_m3 && height >= kRoomHeight_m &&
           gap + grid.resolution_m >= kRoomGap_m;
}

/// Whether a component is enclosed by one piece of furniture, judged by rays from its roomiest
/// cell.
bool isInsideFurniture(const FoundRoom& room, const Scene& scene, const RayCaster& rays,
                       const VoxelGrid& grid, int ray_count) {
    if (volumeOf(room, grid) > kFurnitureVolume_m3) return false;
    const Eigen::Vector3d from =
        grid.centerOf(room.roomiest[0], room.roomiest[1], room.roomiest[2]);
    std::vector<int> hits(scene.objects.size() + 1, 0);
    int structure = 0;
    int hit_count = 0;
    for (int i = 0; i < ray_count; ++i) {
        // Directions of a Fibonacci sphere: uniform over all solid angles.
        const double z = 1.0 - (2.0 * i + 1.0) / ray_count;
        const double turn = i * 2.399963229728653;  // the golden angle
        const double r = std::sqrt(1.0 - z * z);
        const RayHit hit = rays.cast(from, {r * std::cos(turn), r * std::sin(turn), z});
        if (hit.object_id == 0) continue;
        ++hit_count;
        const Object& object = scene.object(hit.object_id);
        Eigen::AlignedBox3d box;
        for (const Eigen::Vector3d& corner : object.box.corners()) box.extend(corner);
        // An object that spans the whole scene is no piece of furniture, whatever its class.
        const bool shell = (box.sizes().array() >= 0.8 * scene.room_bounds.sizes().array()).all();
        if (shell || object.structure) {
            ++structure;
        } else {
            ++hits[hit.object_id];
        }
    }
    // In a room without some of its sides, most rays hit nothing. Furniture is closed.
    const double counted = std::max<double>(hit_count, kLeastHitShare * ray_count);
    return *std::ranges::max_element(hits) >= kOneObjectShare * ray_count ||
           structure < kStructureShare * counted;
}

}  // namespace

std::vector<std::uint8_t> whereSphereFits(const SphereFitInput& input, const JobContext& job) {
    return whereSphereFitsAfter(std::vector<std::uint8_t>(input.grid.size(), 0), {},
                                {wholeGrid(input.grid)}, input, job);
}

std::vector<std::uint8_t> whereSphereFitsAfter(const std::vector<std::uint8_t>& before,
                                               const std::vector<std::uint8_t>& inside_before,
                                               const std::vector<CellBox>& near_moved,
                                               const SphereFitInput& input, const JobContext& job) {
    const VoxelGrid& grid = input.grid;
    const SphereFit sphere_fits(input);
    std::vector<std::uint8_t> fits = before;
    const auto rows =
        static_cast<std::size_t>(grid.count[1]) * static_cast<std::size_t>(grid.count[2]);
    parallelRanges(rows, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin; at < end; ++at) {
            if (job.cancelled()) return;
            const int y = static_cast<int>(at % static_cast<std::size_t>(grid.count[1]));
            const int z = static_cast<int>(at / static_cast<std::size_t>(grid.count[1]));
            const std::size_t row = grid.rowOf(y, z);
            for (const CellBox& box : near_moved) {
                if (box.empty() || !box.contains(box.begin[0], y, z)) continue;
                for (int x = box.begin[0]; x < box.end[0]; ++x) {
                    const std::size_t i = row + static_cast<std::size_t>(x);
                    fits[i] = sphere_fits(i, x, y, z);
                }
            }
            if (inside_before.empty()) continue;
            const std::size_t width = grid.count[0];
            const std::uint8_t* was = inside_before.data() + row;
            const std::uint8_t* is = input.inside.data() + row;
            if (std::equal(was, was + width, is)) continue;
            for (int x = 0; x < grid.count[0]; ++x) {
                const std::size_t i = row + static_cast<std::size_t>(x);
                if (was[x] != is[x]) fits[i] = sphere_fits(i, x, y, z);
            }
        }
    });
    return fits;
}

FoundRooms findRooms(const Scene& scene, const RayCaster& rays, const VoxelGrid& grid,
                     const std::vector<std::uint8_t>& fits,
                     const std::vector<std::uint16_t>& squared_gaps) {
    FoundRooms result;
    const CellComponents pieces = findComponents(grid, fits, 1);
    const std::vector<FoundRoom> measured = measure(grid, pieces, squared_gaps);

    std::vector<std::size_t> order(measured.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(
        order, [&](std::size_t a, std::size_t b) { return measured[a].cells > measured[b].cells; });
    std::vector<std::uint8_t> number(measured.size(), kNoRoom);
    const auto keep = [&](std::size_t piece) {
        if (result.rooms.size() >= kMaxRooms) return;
        number[piece] = static_cast<std::uint8_t>(result.rooms.size());
        result.rooms.push_back(measured[piece]);
    };
    for (const std::size_t piece : order) {
        if (hasRoomSize(measured[piece], grid, squared_gaps) &&
            !isInsideFurniture(measured[piece], scene, rays, grid, kRays)) {
            keep(piece);
        }
    }
    // A very low or narrow scene has no component of room size: take the largest one.
    if (result.rooms.empty() && !order.empty() &&
        volumeOf(measured[order[0]], grid) >= kPocketVolume_m3 &&
        !isInsideFurniture(measured[order[0]], scene, rays, grid, kRays)) {
        keep(order[0]);
    }

    std::vector<std::uint8_t> hollow(measured.size(), 0);
    for (const std::size_t piece : order) {
        if (volumeOf(measured[piece], grid) < kHollowVolume_m3) break;
        if (number[piece] != kNoRoom) continue;
        hollow[piece] = isInsideFurniture(measured[piece], scene, rays, grid, kHollowRays) ? 1 : 0;
    }

    result.room_of_cell.assign(grid.size(), kNoRoom);
    result.hollow.assign(grid.size(), 0);
    const std::size_t columns = grid.rowOf(0, 1);
    std::vector<std::vector<std::uint8_t>> footprints(result.rooms.size(),
                                                      std::vector<std::uint8_t>(columns, 0));
    for (const CellRun& run : pieces.runs) {
        const std::uint8_t room = number[run.component];
        const std::size_t begin = grid.indexOf(run.x_begin, run.y, run.z);
        const std::size_t length = run.x_end - run.x_begin;
        if (room == kNoRoom) {
            std::fill_n(result.hollow.begin() + static_cast<std::ptrdiff_t>(begin), length,
                        hollow[run.component]);
            continue;
        }
        std::fill_n(result.room_of_cell.begin() + static_cast<std::ptrdiff_t>(begin), length, room);
        std::fill_n(footprints[room].begin() + static_cast<std::ptrdiff_t>(begin % columns), length,
                    std::uint8_t{1});
    }
    for (std::size_t i = 0; i < result.rooms.size(); ++i) {
        result.rooms[i].columns = std::ranges::count(footprints[i], 1);
    }
    return result;
}

}  // namespace dollytrack::planning
