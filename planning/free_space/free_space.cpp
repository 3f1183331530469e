#include "planning/free_space/free_space.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/components.h"
#include "planning/free_space/distance_field.h"
#include "planning/free_space/mapping_messages.h"
#include "planning/free_space/octree.h"
#include "planning/free_space/rooms.h"
#include "planning/free_space/scanned_space.h"
#include "planning/free_space/surface_map.h"
#include "planning/visibility/scanned_surfaces.h"

#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <string>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kMaxSampleCells = std::size_t{1} << 19U;
// Strict rules may find too little: below this share of the air the next rule is tried.
constexpr double kEnoughAir = 0.15;

constexpr std::array kRules = {EnclosureRule::Walls, EnclosureRule::FewWalls,
                               EnclosureRule::FloorOnly};
// Margin for the rounding of the ray caster, which measures distances in floats.
constexpr double kHair_m = 0.002;

}  // namespace

/// What an incremental build takes from the earlier map.
struct FreeSpace::Moved {
    const Impl& before;
    std::vector<CellBox> near;  // disjoint boxes around all cells within a camera radius of a moved
                                // object, before or after
};

struct FreeSpace::Impl {
    std::shared_ptr<const SurfaceMap> surfaces;
    VoxelGrid grid;
    double camera_radius_m = 0.0;
    // For a scan: the cells that were scanned, and by rule the inside cells among them.
    std::vector<std::uint8_t> scanned;
    std::optional<double> scanned_share;
    std::array<std::vector<std::uint8_t>, kRules.size()> inside_scanned;
    std::vector<std::uint8_t> cells;  // state and leaf level
    // by rule: cells where the sphere fits; empty if the rule was not tried
    std::array<std::vector<std::uint8_t>, kRules.size()> fits;
    FoundRooms found;
    std::vector<float> gap_m;  // by squared gap
    std::vector<Room> rooms;
    std::vector<std::vector<Eigen::Vector3f>> room_cells;
    std::once_flag octree_asked;  // asked for by pictures and files only, never by planning
    OctreePtr octree;
    Eigen::AlignedBox3d bounds;
    std::once_flag openings_asked;  // asked for by the report only, never by planning
    OpeningReport opening_report;

    [[nodiscard]] const std::vector<std::uint8_t>& inside(EnclosureRule rule);
    void findFits(EnclosureRule rule, const RayCaster& rays, const Moved* moved,
                  const JobContext& job);
    Result<FoundRooms> findBestRooms(const Scene& scene, const RayCaster& rays, const Moved* moved,
                                     EnclosureRule& rule, const JobContext& job);
    void measureScanned(EnclosureRule rule);
    void setStates(const std::vector<std::uint8_t>& inside);
    void describeRooms();
    void collectCells(std::size_t room);
    void makeGapTable();
};

/// Cells inside by a rule; for a scan only the scanned ones, since the rest is unknown.
const std::vector<std::uint8_t>& FreeSpace::Impl::inside(EnclosureRule rule) {
    const std::vector<std::uint8_t>& all = surfaces->inside(rule);
    if (scanned.empty()) return all;
    std::vector<std::uint8_t>& part = inside_scanned[static_cast<std::size_t>(rule)];
    if (part.empty()) {
        part = all;
        for (std::size_t i = 0; i < part.size(); ++i) part[i] &= scanned[i];
    }
    return part;
}

/// Finds the inside cells where the sphere fits, for one rule.
void FreeSpace::Impl::findFits(EnclosureRule rule, const RayCaster& rays, const Moved* moved,
                               const JobContext& job) {
    const SphereFitInput input{
        rays, grid, surfaces->surfaces().cells, surfaces->gaps(), inside(rule), camera_radius_m};
    const auto index = static_cast<std::size_t>(rule);
    const bool known = moved != nullptr && !moved->before.fits[index].empty();
    fits[index] =
        known ? whereSphereFitsAfter(moved->before.fits[index],
                                     moved->before.surfaces->inside(rule), moved->near, input, job)
              : whereSphereFits(input, job);
}

/// The rooms by the strictest rule that finds enough air. Sets `rule`.
Result<FoundRooms> FreeSpace::Impl::findBestRooms(const Scene& scene, const RayCaster& rays,
                                                  const Moved* moved, EnclosureRule& rule,
                                                  const JobContext& job) {
    FoundRooms best;
    std::int64_t best_cells = 0;
    double stage = 0.0;
    for (const EnclosureRule tried : kRules) {
        findFits(tried, rays, moved, job);
        if (job.cancelled()) return mappingCancelled();
        job.report(stage += 0.1);
        FoundRooms tried_rooms =
            findRooms(scene, rays, grid, fits[static_cast<std::size_t>(tried)], surfaces->gaps());
        if (job.cancelled()) return mappingCancelled();
        job.report(stage += 0.1);
        std::int64_t cells_found = 0;
        for (const FoundRoom& room : tried_rooms.rooms) cells_found += room.cells;
        // A laxer rule replaces a stricter one only if that found next to nothing.
        if (best.room_of_cell.empty() ||
            kEnoughAir * static_cast<double>(cells_found) > static_cast<double>(best_cells)) {
            best = std::move(tried_rooms);
            best_cells = cells_found;
            rule = tried;
        }
        if (static_cast<double>(best_cells) >=
            kEnoughAir * static_cast<double>(surfaces->airCells())) {
            break;
        }
    }
    return best;
}

/// Computes the share of the inside cells that was scanned.
void FreeSpace::Impl::measureScanned(EnclosureRule rule) {
    if (scanned.empty()) return;
    const auto cells_inside = static_cast<double>(std::ranges::count(surfaces->inside(rule), 1));
    scanned_share = static_cast<double>(std::ranges::count(inside(rule), 1)) / cells_inside;
}

/// Sets the state of every cell: inside air connected with a room is free.
void FreeSpace::Impl::setStates(const std::vector<std::uint8_t>& inside) {
    std::vector<std::uint8_t> open(grid.size());
    const std::vector<std::uint8_t>& surface = surfaces->surfaces().cells;
    cells.resize(grid.size());
    parallelRanges(grid.size(), 1U << 16U, [&](std::size_t begin, std::size_t end) {
        // Local pointers let the compiler vectorise these loops.
        const std::uint8_t* in = inside.data();
        const std::uint8_t* hollow = found.hollow.data();
        const std::uint8_t* on_surface = surface.data();
        std::uint8_t* is_open = open.data();
        std::uint8_t* cell = cells.data();
        for (std::size_t i = begin; i < end; ++i) {
            is_open[i] = static_cast<std::uint8_t>((in[i] != 0) & (hollow[i] == 0));
        }
        for (std::size_t i = begin; i < end; ++i) {
            cell[i] = on_surface[i] != 0 ? kOccupiedCell : kUnknownCell;
        }
    });
    const CellComponents air = findComponents(grid, open, 1);
    std::vector<std::uint8_t> has_room(air.cells.size(), 0);
    for (const CellRun& run : air.runs) {
        const std::size_t component = run.component;
        if (has_room[component] != 0) continue;
        const auto row = found.room_of_cell.begin() +
                         static_cast<std::ptrdiff_t>(grid.indexOf(run.x_begin, run.y, run.z));
        has_room[component] = std::any_of(row, row + (run.x_end - run.x_begin),
                                          [](std::uint8_t room) { return room != kNoRoom; });
    }
    for (const CellRun& run : air.runs) {
        if (has_room[run.component] == 0) continue;
        std::fill_n(
            cells.begin() + static_cast<std::ptrdiff_t>(grid.indexOf(run.x_begin, run.y, run.z)),
            run.x_end - run.x_begin, kFreeCell);
    }
}

void FreeSpace::Impl::describeRooms() {
    const double size = grid.resolution_m;
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * size);
    for (const FoundRoom& from : found.rooms) {
        Room room;
        room.component = static_cast<int>(rooms.size());
        room.box.extend(grid.centerOf(from.low[0], from.low[1], from.low[2]) - half);
        room.box.extend(grid.centerOf(from.high[0], from.high[1], from.high[2]) + half);
        room.volume_m3 = static_cast<double>(from.cells) * size * size * size;
        room.floor_area_m2 = static_cast<double>(from.columns) * size * size;
        room.sample = grid.centerOf(from.roomiest[0], from.roomiest[1], from.roomiest[2]);
        rooms.push_back(room);
    }
    room_cells.resize(rooms.size());
    parallelFor(rooms.size(), [&](std::size_t room) { collectCells(room); });
}

void FreeSpace::Impl::collectCells(std::size_t room) {
    const double volume_cells = rooms[room].volume_m3 / std::pow(grid.resolution_m, 3);
    const auto count = static_cast<std::size_t>(std::llround(volume_cells));
    const std::size_t every = (count + kMaxSampleCells - 1) / kMaxSampleCells;
    const std::array<int, 3>& low = found.rooms[room].low;
    const std::array<int, 3>& high = found.rooms[room].high;
    std::vector<std::vector<Eigen::Vector3f>> slices(static_cast<std::size_t>(high[2] - low[2]) +
                                                     1);
    parallelFor(slices.size(), [&](std::size_t slice) {
        const int z = low[2] + static_cast<int>(slice);
        for (int y = low[1]; y <= high[1]; ++y) {
            const std::size_t row = grid.rowOf(y, z);
            const std::uint8_t* room_of = found.room_of_cell.data() + row;
            for (int x = low[0]; x <= high[0]; ++x) {
                if (room_of[x] != room) continue;
                const std::size_t i = row + static_cast<std::size_t>(x);
                // A hashed choice: taking every n-th cell in order would leave stripes.
                if (every > 1 && ((i * 0x9E3779B97F4A7C15U) >> 32U) % every != 0) continue;
                slices[slice].emplace_back(grid.centerOf(x, y, z).cast<float>());
            }
        }
    });
    std::vector<Eigen::Vector3f>& centers = room_cells[room];
    std::size_t all = 0;
    for (const auto& slice : slices) all += slice.size();
    centers.reserve(all);
    for (const auto& slice : slices) centers.insert(centers.end(), slice.begin(), slice.end());
}

void FreeSpace::Impl::makeGapTable() {
    // Surface cells are marked with a small tolerance, so gaps are exact; the factor covers the
    // rounding of the ray caster's floats.
    gap_m.resize(std::size_t{kMaxSquaredGap} + 1);
    for (std::size_t i = 0; i < gap_m.size(); ++i) {
        gap_m[i] =
            static_cast<float>(std::sqrt(static_cast<double>(i)) * grid.resolution_m * 0.9999);
    }
}

namespace {

/// Why a scene has no room for the camera, and what can be done.
std::string whyNoRoom(const Scene& scene, double camera_radius_m, double resolution_m) {
    const Eigen::Vector3d size = scene.room_bounds.sizes();
    const std::string extent =
        inMetres(size.x()) + " x " + inMetres(size.y()) + " x " + inMetres(size.z());
    const std::string frame = "check --unit and --up (the scene is " + extent + ")";
    if (scene.objects.size() == 1) {
        return "the scene is a single object without space for a camera in it; split it, or " +
               frame;
    }
    if (std::ranges::none_of(scene.objects, &Object::structure)) {
        return "no object is a floor, wall or ceiling, and no space between the objects fits a "
               "camera; name the walls with --labels, or " +
               frame;
    }
    return "no room has space for a camera of radius " + inMetres(camera_radius_m) +
           " at cells of " + inMetres(resolution_m) +
           "; lower camera_radius_m and near_m, or octree_resolution_m, or " + frame;
}

}  // namespace

FreeSpace::FreeSpace(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FreeSpace::~FreeSpace() = default;
FreeSpace::FreeSpace(FreeSpace&&) noexcept = default;
FreeSpace& FreeSpace::operator=(FreeSpace&&) noexcept = default;

Result<FreeSpace> FreeSpace::build(const Scene& scene, const RayCaster& rays,
                                   const CameraParams& camera, const FreeSpaceParams& params,
                                   const JobContext& job) {
    auto surfaces = SurfaceMap::build(scene, params, job.stage(0.0, 0.4, "surfaces"));
    if (!surfaces) return tl::unexpected(std::move(surfaces.error()));
    return buildOver(std::make_shared<const SurfaceMap>(std::move(*surfaces)), scene, rays, camera,
                     job.stage(0.4, 1.0, "rooms"));
}

Result<FreeSpace> FreeSpace::buildOver(std::shared_ptr<const SurfaceMap> surfaces,
                                       const Scene& scene, const RayCaster& rays,
                                       const CameraParams& camera, const JobContext& job) {
    return make(std::move(surfaces), nullptr, scene, rays, camera, job);
}

Result<FreeSpace> FreeSpace::afterMoves(const FreeSpace& before,
                                        std::shared_ptr<const SurfaceMap> surfaces,
                                        const std::vector<int>& moved, const Scene& scene,
                                        const RayCaster& rays, const CameraParams& camera,
                                        const JobContext& job) {
    const Impl& old = *before.impl_;
    const VoxelGrid& grid = surfaces->grid();
    if (!(grid == old.grid) || camera.camera_radius_m != old.camera_radius_m) {
        return make(std::move(surfaces), nullptr, scene, rays, camera, job);
    }
    Moved from{old, {}};
    const Eigen::Vector3d reach =
        Eigen::Vector3d::Constant((camera.camera_radius_m + kHair_m) / grid.resolution_m);
    for (const int id : moved) {
        for (const SurfaceMap* map : {old.surfaces.get(), surfaces.get()}) {
            const Eigen::AlignedBox3d& box = map->surfaces().reach[id - 1].box_in_cells;
            if (box.isEmpty()) continue;
            from.near.push_back(cellsAround(grid, {box.min() - reach, box.max() + reach}));
        }
    }
    from.near = apart(from.near);
    return make(std::move(surfaces), &from, scene, rays, camera, job);
}

Result<FreeSpace> FreeSpace::make(std::shared_ptr<const SurfaceMap> surfaces, const Moved* moved,
                                  const Scene& scene, const RayCaster& rays,
                                  const CameraParams& camera, const JobContext& job) {
    if (!(camera.camera_radius_m >= 0.01 && camera.camera_radius_m <= 1.0)) {
        return fail(ErrorCode::BadInput, "must be 0.01 to 1 m", "camera_radius_m");
    }
    auto impl = std::make_unique<Impl>();
    impl->surfaces = std::move(surfaces);
    impl->grid = impl->surfaces->grid();
    impl->camera_radius_m = camera.camera_radius_m;
    const ScannedSurfaces scan(scene);
    if (scan.isScan()) {
        moved = nullptr;  // a moved object changes which part of the scan is visible from anywhere
        impl->scanned =
            findScannedSpace(impl->grid, impl->surfaces->surfaces().cells, scan, rays, job);
    }
    EnclosureRule rule = EnclosureRule::Walls;
    Result<FoundRooms> found = impl->findBestRooms(scene, rays, moved, rule, job);
    if (found && found->rooms.empty() && scan.isScan()) {
        // The scanned part has no room for the camera: use all of it and judge views one by one.
        impl->scanned.clear();
        impl->scanned_share = 0.0;
        found = impl->findBestRooms(scene, rays, moved, rule, job);
    }
    if (!found) return tl::unexpected(found.error());
    if (found->rooms.empty()) {
        return fail(ErrorCode::BadInput,
                    whyNoRoom(scene, camera.camera_radius_m, impl->grid.resolution_m), scene.name);
    }
    impl->found = std::move(*found);
    impl->measureScanned(rule);
    impl->setStates(impl->inside(rule));
    impl->scanned = {};
    impl->inside_scanned = {};
    impl->describeRooms();
    if (job.cancelled()) return mappingCancelled();
    job.report(0.8);

    if (moved != nullptr) {
        markLeavesAfter(moved->before.cells, moved->near, impl->grid, impl->cells);
    } else {
        markLeaves(impl->grid, impl->cells);
    }
    impl->bounds = impl->grid.box();
    impl->makeGapTable();
    job.report(1.0);
    return FreeSpace(std::move(impl));
}

CellState FreeSpace::stateAt(const Eigen::Vector3d& point) const {
    std::array<int, 3> cell;
    if (!impl_->grid.find(point, cell)) return CellState::Unknown;
    const std::uint8_t value =
        impl_->cells[impl_->grid.indexOf(cell[0], cell[1], cell[2])] & kCellStateMask;
    return value == kFreeCell       ? CellState::Free
           : value == kOccupiedCell ? CellState::Occupied
                                    : CellState::Unknown;
}

double FreeSpace::cellSizeAt(const Eigen::Vector3d& point) const {
    std::array<int, 3> cell;
    const VoxelGrid& grid = impl_->grid;
    if (!grid.find(point, cell)) return grid.resolution_m;
    return std::ldexp(grid.resolution_m,
                      impl_->cells[grid.indexOf(cell[0], cell[1], cell[2])] >> kCellLevelShift);
}

double FreeSpace::clearanceLowerBound(const Eigen::Vector3d& point) const {
    std::array<int, 3> cell;
    const VoxelGrid& grid = impl_->grid;
    if (!grid.find(point, cell)) return 0.0;
    const std::size_t i = grid.indexOf(cell[0], cell[1], cell[2]);
    if ((impl_->cells[i] & kCellStateMask) != kFreeCell) return 0.0;
    double clearance = impl_->gap_m[impl_->surfaces->gaps()[i]];
    // Surfaces outside the map lie beyond one of its sides.
    const std::array<double, 6>& gap_beyond_m = impl_->surfaces->surfaces().gap_beyond_m;
    for (unsigned k = 0; k < 3; ++k) {
        clearance = std::min({clearance, point[k] - impl_->bounds.min()[k] + gap_beyond_m[2 * k],
                              impl_->bounds.max()[k] - point[k] + gap_beyond_m[2 * k + 1]});
    }
    return clearance;
}

int FreeSpace::componentAt(const Eigen::Vector3d& point) const {
    std::array<int, 3> cell;
    if (!impl_->grid.find(point, cell)) return -1;
    const std::uint8_t room =
        impl_->found.room_of_cell[impl_->grid.indexOf(cell[0], cell[1], cell[2])];
    return room == kNoRoom ? -1 : room;
}

bool FreeSpace::inOneFreeLeaf(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    std::array<int, 3> cell_a;
    std::array<int, 3> cell_b;
    const VoxelGrid& grid = impl_->grid;
    if (!grid.find(a, cell_a) || !grid.find(b, cell_b)) return false;
    const std::uint8_t value = impl_->cells[grid.indexOf(cell_a[0], cell_a[1], cell_a[2])];
    if ((value & kCellStateMask) != kFreeCell) return false;
    const int level = value >> kCellLevelShift;
    for (unsigned k = 0; k < 3; ++k) {
        // Right shifts of negative numbers round down, as the octree's keys do.
        if ((grid.first[k] + cell_a[k]) >> level != (grid.first[k] + cell_b[k]) >> level) {
            return false;
        }
    }
    return true;
}

const std::vector<Room>& FreeSpace::rooms() const {
    return impl_->rooms;
}

const std::vector<Eigen::Vector3f>& FreeSpace::cells(int component) const {
    return impl_->room_cells[component];
}

const octomap::OcTree& FreeSpace::octree() const {
    std::call_once(impl_->octree_asked,
                   [&] { impl_->octree = growOctree(impl_->grid, impl_->cells); });
    return *impl_->octree;
}

void FreeSpace::visitLeaves(const std::function<void(const FreeSpaceLeaf&)>& visit) const {
    const octomap::OcTree& tree = octree();
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
        FreeSpaceLeaf seen;
        seen.center = {leaf.getX(), leaf.getY(), leaf.getZ()};
        seen.size_m = leaf.getSize();
        seen.level = static_cast<int>(tree.getTreeDepth() - leaf.getDepth());
        seen.state = tree.isNodeOccupied(*leaf) ? CellState::Occupied : CellState::Free;
        visit(seen);
    }
}

const Eigen::AlignedBox3d& FreeSpace::bounds() const {
    return impl_->bounds;
}
std::optional<double> FreeSpace::scannedShare() const {
    return impl_->scanned_share;
}

double FreeSpace::resolution_m() const {
    return impl_->grid.resolution_m;
}
const OpeningReport& FreeSpace::openingReport() const {
    std::call_once(impl_->openings_asked, [&] {
        impl_->opening_report = findOpenings(impl_->grid, impl_->cells, impl_->found);
    });
    return impl_->opening_report;
}

}  // namespace dollytrack::planning
