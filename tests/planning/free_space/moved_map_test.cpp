// The map that is updated only where objects moved must equal the one made from scratch.

#include "engine/document/apply_scene_edits.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/move_object.h"
#include "planning/free_space/distance_field.h"
#include "planning/free_space/octree.h"
#include "planning/free_space/surface_map.h"
#include "tests/planning/support/map_support.h"
#include "tests/planning/support/moving_support.h"

#include <gtest/gtest.h>

#include <memory>

namespace dollytrack::planning::moved_map_test {
namespace {

using namespace test_support;

/// A map and what it was made from.
struct Mapped {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const RayCaster> rays;
    std::shared_ptr<const SurfaceMap> surfaces;
    std::shared_ptr<const FreeSpace> free_space;  // null: no room
};

Mapped fromScratch(const std::shared_ptr<const Scene>& scene) {
    Mapped made{scene, std::make_shared<const RayCaster>(*scene), nullptr, nullptr};
    auto surfaces = SurfaceMap::build(*scene, {});
    if (!surfaces) throw std::runtime_error(describe(surfaces.error()));
    made.surfaces = std::make_shared<const SurfaceMap>(std::move(*surfaces));
    auto map = FreeSpace::buildOver(made.surfaces, *scene, *made.rays, {});
    if (map) made.free_space = std::make_shared<const FreeSpace>(std::move(*map));
    return made;
}

Mapped afterMoves(const Mapped& before, const std::shared_ptr<const Scene>& scene) {
    const std::vector<int> moved = *movedObjects(*before.scene, *scene);
    Mapped made{scene, std::make_shared<const RayCaster>(*scene, *before.rays, moved), nullptr,
                nullptr};
    auto surfaces = SurfaceMap::afterMoves(*before.surfaces, *scene, moved, {});
    if (!surfaces) throw std::runtime_error(describe(surfaces.error()));
    made.surfaces = std::make_shared<const SurfaceMap>(std::move(*surfaces));
    auto map = before.free_space ? FreeSpace::afterMoves(*before.free_space, made.surfaces, moved,
                                                         *scene, *made.rays, {})
                                 : FreeSpace::buildOver(made.surfaces, *scene, *made.rays, {});
    if (map) made.free_space = std::make_shared<const FreeSpace>(std::move(*map));
    return made;
}

void expectSameRooms(const FreeSpace& a, const FreeSpace& b) {
    ASSERT_EQ(a.rooms().size(), b.rooms().size());
    for (std::size_t i = 0; i < a.rooms().size(); ++i) {
        const Room& room = a.rooms()[i];
        const Room& other = b.rooms()[i];
        EXPECT_EQ(room.sample, other.sample);
        EXPECT_EQ(room.volume_m3, other.volume_m3);
        EXPECT_EQ(room.floor_area_m2, other.floor_area_m2);
        EXPECT_EQ(a.cells(room.component), b.cells(room.component));
    }
    EXPECT_EQ(a.openingReport().openings.size(), b.openingReport().openings.size());
}

/// Compares every cell of the two maps with every query.
void expectSame(const Mapped& a, const Mapped& b) {
    EXPECT_EQ(a.surfaces->surfaces().cells, b.surfaces->surfaces().cells);
    EXPECT_EQ(a.surfaces->surfaces().gap_beyond_m, b.surfaces->surfaces().gap_beyond_m);
    EXPECT_EQ(a.surfaces->gaps(), b.surfaces->gaps());
    EXPECT_EQ(a.surfaces->airCells(), b.surfaces->airCells());
    for (const EnclosureRule rule :
         {EnclosureRule::Walls, EnclosureRule::FewWalls, EnclosureRule::FloorOnly}) {
        EXPECT_EQ(a.surfaces->inside(rule), b.surfaces->inside(rule));
    }
    ASSERT_EQ(a.free_space != nullptr, b.free_space != nullptr);
    if (!a.free_space) return;
    expectSameRooms(*a.free_space, *b.free_space);
    const VoxelGrid& grid = a.surfaces->grid();
    std::size_t different = 0;
    visitRows(wholeGrid(grid), grid, [&](std::size_t begin, std::size_t end, int x, int y, int z) {
        for (std::size_t i = begin; i < end; ++i, ++x) {
            const Eigen::Vector3d at = grid.centerOf(x, y, z);
            const FreeSpace& m = *a.free_space;
            const FreeSpace& n = *b.free_space;
            if (m.stateAt(at) != n.stateAt(at) || m.cellSizeAt(at) != n.cellSizeAt(at) ||
                m.componentAt(at) != n.componentAt(at) ||
                m.clearanceLowerBound(at) != n.clearanceLowerBound(at)) {
                ++different;
            }
        }
    });
    EXPECT_EQ(different, 0U);
}

/// Without structure objects every upright surface is a wall.
Scene withoutStructure(Scene scene) {
    for (Object& object : scene.objects) object.structure = false;
    return scene;
}

void moveAtRandom(const Scene& imported, std::uint64_t seed, int steps) {
    Random random(seed, 11);
    SceneEdits edits;
    Mapped kept = fromScratch(std::make_shared<const Scene>(imported));
    for (int step = 0; step < steps; ++step) {
        for (const ObjectChange& change : anyMoves(imported, random)) setMove(edits, change);
        // Now and then a part of the building moves, too.
        if (random.below(4) == 0) {
            const auto any = random.below(static_cast<std::uint32_t>(imported.objects.size()));
            setMove(edits, moveOf(imported, imported.objects[any].name,
                                  {{0.3 * random.uniform(), 0.2 * random.uniform(), 0.0}, 0.0}));
        }
        const auto scene = std::make_shared<const Scene>(*applySceneEdits(imported, edits));
        setThreadCount(step % 2 == 0 ? 4 : 1);
        kept = afterMoves(kept, scene);
        setThreadCount(step % 2 == 0 ? 1 : 4);
        SCOPED_TRACE(fmt::format("seed {}, step {}", seed, step));
        expectSame(kept, fromScratch(scene));
    }
    setThreadCount(0);
}

}  // namespace

TEST(MovedMap, IsTheOneFromScratchWhateverMoves) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Random random(seed, 7);
        moveAtRandom(anyFlat(random, 1 + static_cast<int>(seed % 3)), seed, 8);
    }
}

TEST(MovedMap, IsTheOneFromScratchInOpenAndUnnamedBuildings) {
    for (std::uint64_t seed = 5; seed <= 8; ++seed) {
        Random random(seed, 7);
        const Scene flat = anyFlat(random, 2, seed % 2 == 0);
        moveAtRandom(seed < 7 ? withoutStructure(flat) : flat, seed, 6);
    }
}

// An imported apartment with 250 objects in four rooms.
TEST(MovedMap, IsTheOneFromScratchInTheApartment) {
    auto apartment = importScene(DOLLYTRACK_APARTMENT);
    ASSERT_TRUE(apartment) << describe(apartment.error());
    moveAtRandom(*apartment, 9, 4);
}

// In a hall gaps are far larger than those at furniture, and moving the only object away changes
// the nearest surface everywhere.
TEST(MovedMap, GapsAreExactWhereTheOnlyThingNearLeaves) {
    VoxelGrid grid;
    grid.count = {90, 70, 60};
    Random random(4, 7);
    const auto any = [&](int count) { return static_cast<int>(random.below(count)); };
    std::vector<std::uint8_t> surface(grid.size(), 0);
    std::vector<std::uint16_t> gaps = squaredGaps(grid, surface, {});
    for (int step = 0; step < 30; ++step) {
        std::vector<CellBox> changed;
        for (int i = 0; i < 2; ++i) {
            CellBox box = {{any(84), any(64), any(54)}, {}};
            for (unsigned k = 0; k < 3; ++k) box.end[k] = box.begin[k] + 1 + any(6);
            // Objects come and go; every tenth step removes all of them.
            if (step % 10 == 9) box = wholeGrid(grid);
            const std::uint8_t to = step % 10 == 9 ? 0 : static_cast<std::uint8_t>(any(3) != 0);
            visitRows(box, grid, [&](std::size_t begin, std::size_t end, int, int, int) {
                for (std::size_t c = begin; c < end; ++c) surface[c] = to;
            });
            changed.push_back(box);
        }
        gaps = squaredGapsAfter(gaps, changed, grid, surface, {});
        ASSERT_EQ(gaps, squaredGaps(grid, surface, {})) << "step " << step;
    }
}

TEST(MovedMap, LeavesAreThoseOfTheWholeTree) {
    VoxelGrid grid;
    grid.first = {-13, 5, -40};
    grid.count = {70, 50, 66};
    Random random(6, 7);
    const auto any = [&](int count) { return static_cast<int>(random.below(count)); };
    std::vector<std::uint8_t> cells(grid.size(), kFreeCell);
    markLeaves(grid, cells);
    for (int step = 0; step < 60; ++step) {
        std::vector<std::uint8_t> now = cells;
        for (std::uint8_t& cell : now) cell &= kCellStateMask;
        std::vector<CellBox> likely;
        for (int i = 0; i < 3; ++i) {
            CellBox box = {{any(60), any(40), any(56)}, {}};
            for (unsigned k = 0; k < 3; ++k) box.end[k] = box.begin[k] + 1 + any(i == 0 ? 10 : 2);
            visitRows(box, grid,
                      [&, to = any(3)](std::size_t begin, std::size_t end, int, int, int) {
                          for (std::size_t c = begin; c < end; ++c)
                              now[c] = static_cast<std::uint8_t>(to);
                      });
            if (i < 2) likely.push_back(box);  // the third is not among the likely ones
        }
        std::vector<std::uint8_t> whole = now;
        markLeaves(grid, whole);
        markLeavesAfter(cells, likely, grid, now);
        ASSERT_EQ(now, whole) << "step " << step;
        cells = now;
    }
}

}  // namespace dollytrack::planning::moved_map_test
