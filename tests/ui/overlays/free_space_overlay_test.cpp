#include "ui/overlays/free_space_overlay.h"

#include "engine/camera/intrinsics.h"
#include "tests/ui/overlays/planned_room.h"
#include "ui/overlays/palette.h"

#include <gtest/gtest.h>

#include <map>

#include <cmath>
#include <set>

namespace dollytrack::ui::free_space_overlay_test {
namespace {

using planning::CellState;
using planning::FreeSpace;

FreeSpace mapOf(const Scene& scene) {
    auto map = FreeSpace::build(scene, RayCaster(scene), CameraParams{}, {0.1}, JobContext{});
    if (!map) throw std::runtime_error(describe(map.error()));
    return std::move(*map);
}

int countOf(const Legend& legend, const std::string& name) {
    for (const LegendEntry& entry : legend.entries) {
        if (entry.name == name) return entry.count;
    }
    return -1;
}

double volumeOf(const render::Overlay& overlay) {
    double volume = 0.0;
    for (const render::OverlayBox& box : overlay.boxes) volume += 8.0 * box.half_size.prod();
    return volume;
}

/// Number of cells of one state whose centres lie in [low, high) along an axis, counted one by one.
int cellsIn(const FreeSpace& map, CellState state, int axis, double low, double high) {
    const double cell = map.resolution_m();
    const Eigen::AlignedBox3d box = map.bounds();
    const Eigen::Vector3i size = (box.sizes() / cell).array().round().cast<int>();
    int count = 0;
    for (int z = 0; z < size.z(); ++z) {
        for (int y = 0; y < size.y(); ++y) {
            for (int x = 0; x < size.x(); ++x) {
                const Eigen::Vector3d center =
                    box.min() + cell * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
                count += center[axis] >= low && center[axis] < high && map.stateAt(center) == state;
            }
        }
    }
    return count;
}

TEST(FreeSpaceLayer, ShowsEveryLeafOnceWithItsState) {
    const FreeSpace map = mapOf(dollytrack::test::furnishedRoom());
    int free = 0;
    int occupied = 0;
    double volume = 0.0;
    map.visitLeaves([&](const planning::FreeSpaceLeaf& leaf) {
        ++(leaf.state == CellState::Free ? free : occupied);
        volume += std::pow(leaf.size_m, 3);
    });
    const PlanLayer layer = freeSpaceLayer(map, {});
    EXPECT_EQ(layer.overlay.boxes.size(), static_cast<std::size_t>(free + occupied));
    EXPECT_EQ(countOf(layer.legend, "Free"), free);
    EXPECT_EQ(countOf(layer.legend, "Occupied"), occupied);
    EXPECT_EQ(countOf(layer.legend, "Unknown"), -1);  // not without a slice
    EXPECT_NEAR(volumeOf(layer.overlay), volume, 1e-6);
}

TEST(FreeSpaceLayer, ASliceHoldsEachOfItsCellsOnce) {
    const FreeSpace map = mapOf(dollytrack::test::furnishedRoom());
    const double cell = map.resolution_m();
    for (const int axis : {0, 1, 2}) {
        for (const CellState state : {CellState::Free, CellState::Occupied, CellState::Unknown}) {
            FreeSpaceOverlayOptions options;
            options.slice = Slice{axis, 0.74, 2.0 * cell};
            options.free = state == CellState::Free;
            options.occupied = state == CellState::Occupied;
            options.unknown = state == CellState::Unknown;
            const PlanLayer layer = freeSpaceLayer(map, options);
            const int cells = cellsIn(map, state, axis, 0.7, 0.9);
            EXPECT_NEAR(volumeOf(layer.overlay) / std::pow(cell, 3), cells, 1e-6);
            for (const render::OverlayBox& box : layer.overlay.boxes) {
                EXPECT_GE(box.center[axis] - box.half_size[axis], 0.7 - 1e-9);
                EXPECT_LE(box.center[axis] + box.half_size[axis], 0.9 + 1e-9);
                EXPECT_EQ(map.stateAt(box.center + Eigen::Vector3d::Constant(1e-6)), state);
            }
        }
    }
}

TEST(FreeSpaceLayer, ASliceOutsideTheMapIsEmpty) {
    const FreeSpace map = mapOf(dollytrack::test::furnishedRoom());
    FreeSpaceOverlayOptions options;
    options.slice = Slice{2, 50.0, 0.1};
    EXPECT_TRUE(freeSpaceLayer(map, options).overlay.boxes.empty());
}

TEST(FreeSpaceLayer, LevelsPickLeavesBySize) {
    const FreeSpace map = mapOf(dollytrack::test::furnishedRoom());
    FreeSpaceOverlayOptions options;
    std::size_t sum = 0;
    for (int level = 0; level <= 16; ++level) {
        options.min_level = options.max_level = level;
        const PlanLayer layer = freeSpaceLayer(map, options);
        for (const render::OverlayBox& box : layer.overlay.boxes) {
            EXPECT_NEAR(2.0 * box.half_size.x(), std::ldexp(map.resolution_m(), level), 1e-9);
        }
        sum += layer.overlay.boxes.size();
    }
    EXPECT_EQ(sum, freeSpaceLayer(map, {}).overlay.boxes.size());
}

TEST(FreeSpaceLayer, ClearanceGrowsFromDarkToBright) {
    const FreeSpace map = mapOf(dollytrack::test::furnishedRoom());
    FreeSpaceOverlayOptions options;
    options.color = CellColor::Clearance;
    options.slice = Slice{2, 1.5, 0.1};
    options.occupied = options.unknown = false;
    const PlanLayer layer = freeSpaceLayer(map, options);
    ASSERT_TRUE(layer.legend.scale);
    double most = 0.0;
    for (const render::OverlayBox& box : layer.overlay.boxes) {
        const double clearance = map.clearanceLowerBound(box.center);
        most = std::max(most, clearance);
        const double share = clearance / layer.legend.scale->max;
        EXPECT_LT((box.rgba - withOpacity(scaleColor(share), 0.5F)).cwiseAbs().maxCoeff(), 0.12F);
        EXPECT_LE(2.0 * box.half_size.x(), 4.0 * map.resolution_m() + 1e-9);
    }
    EXPECT_DOUBLE_EQ(layer.legend.scale->max, most);
}

TEST(FreeSpaceLayer, RoomsHaveColoursOfTheirOwn) {
    const FreeSpace map = mapOf(dollytrack::test::twoRoomsWithDoor(0.0));
    ASSERT_EQ(map.rooms().size(), 2U);
    FreeSpaceOverlayOptions options;
    options.color = CellColor::Component;
    options.occupied = false;
    const PlanLayer layer = freeSpaceLayer(map, options);
    EXPECT_GT(countOf(layer.legend, "Room 1"), 0);
    EXPECT_GT(countOf(layer.legend, "Room 2"), 0);
    int sum = 0;
    for (const LegendEntry& entry : layer.legend.entries) sum += entry.count;
    EXPECT_EQ(sum, static_cast<int>(layer.overlay.boxes.size()));
}

TEST(FreeSpaceLayer, LevelsHaveColoursOfTheirOwn) {
    const FreeSpace map = mapOf(dollytrack::test::furnishedRoom());
    std::map<int, int> leaves;
    map.visitLeaves([&](const planning::FreeSpaceLeaf& leaf) {
        if (leaf.state == planning::CellState::Free) ++leaves[leaf.level];
    });
    ASSERT_GT(leaves.size(), 2U);
    FreeSpaceOverlayOptions options;
    options.color = CellColor::Level;
    options.occupied = false;
    const PlanLayer layer = freeSpaceLayer(map, options);
    ASSERT_EQ(layer.legend.entries.size(), leaves.size());
    std::size_t entry = 0;
    for (const auto& [level, count] : leaves) {
        EXPECT_EQ(layer.legend.entries[entry].count, count) << level;
        if (entry > 0) {
            EXPECT_NE(layer.legend.entries[entry].rgba, layer.legend.entries[entry - 1].rgba);
        }
        ++entry;
    }
}

TEST(VoxelAt, FindsTheCellInTheSliceUnderThePointer) {
    const FreeSpace map = mapOf(dollytrack::test::furnishedRoom());
    CameraParams camera;
    camera.width_px = 200;
    camera.height_px = 160;
    render::View view;
    view.intrinsics = makeIntrinsics(camera);
    view.pose = lookAt({2.0, 1.5, 8.0}, {2.0, 1.5, 0.0});
    FreeSpaceOverlayOptions options;
    options.slice = Slice{2, 0.35, 0.1};
    for (const bool parallel : {false, true}) {
        if (parallel) view.orthographic = render::Orthographic{40.0, 50.0};
        std::set<CellState> met;
        for (int y = 5; y < 160; y += 10) {
            for (int x = 5; x < 200; x += 10) {
                const Eigen::Vector2d pixel(x + 0.3, y + 0.7);
                const render::ViewRay ray = view.rayThrough(pixel.x(), pixel.y());
                // Where the ray enters the slab from above.
                const Eigen::Vector3d point =
                    ray.origin + (0.4 - 1e-5 - ray.origin.z()) / ray.direction.z() * ray.direction;
                const auto voxel = voxelAt(map, view, pixel, options);
                if (!map.bounds().contains(point)) continue;
                ASSERT_TRUE(voxel);
                EXPECT_LE((voxel->center - point).cwiseAbs().maxCoeff(), 0.05 + 1e-4);
                EXPECT_EQ(voxel->state, map.stateAt(point));
                EXPECT_EQ(voxel->component, map.componentAt(point));
                met.insert(voxel->state);
            }
        }
        EXPECT_TRUE(met.contains(CellState::Free));
        EXPECT_TRUE(met.contains(CellState::Occupied));
    }
}

TEST(VoxelAt, PassesThroughWhatIsNotShown) {
    const FreeSpace map = mapOf(dollytrack::test::furnishedRoom());
    render::View view;
    view.intrinsics = makeIntrinsics({});
    view.pose = lookAt({2.0, 1.5, 2.0}, {2.0, 1.5, 0.0});
    FreeSpaceOverlayOptions options;
    options.free = false;
    const auto voxel = voxelAt(map, view, {320.5, 240.5}, options);
    ASSERT_TRUE(voxel);
    EXPECT_EQ(voxel->state, CellState::Occupied);
    EXPECT_EQ(voxel->clearance_m, 0.0);
    options.occupied = false;
    EXPECT_FALSE(voxelAt(map, view, {320.5, 240.5}, options));
}

}  // namespace
}  // namespace dollytrack::ui::free_space_overlay_test
