#include "planning/free_space/free_space.h"

#include "engine/core/random.h"
#include "engine/jobs/parallel.h"
#include "tests/planning/support/map_support.h"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <array>
#include <atomic>
#include <memory>
#include <set>
#include <sstream>

namespace dollytrack::planning::free_space_test {

using Eigen::Vector3d;
using test_support::map;
using test_support::tryMap;

TEST(FreeSpace, AClosedRoomIsFreeInsideAndUnknownInFurniture) {
    const FreeSpace space = map(test::furnishedRoom());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_EQ(space.stateAt({2.0, 1.5, 1.2}), CellState::Free);
    EXPECT_EQ(space.componentAt({2.0, 1.5, 1.2}), 0);
    EXPECT_EQ(space.stateAt({0.5, 1.5, 0.35}), CellState::Unknown) << "inside the sofa";
    EXPECT_EQ(space.componentAt({0.5, 1.5, 0.35}), -1);
    EXPECT_EQ(space.stateAt({0.9, 1.5, 0.35}), CellState::Occupied) << "the sofa's side";
    EXPECT_EQ(space.stateAt({3.3, 1.5, 0.3}), CellState::Free) << "under the table";
    EXPECT_EQ(space.stateAt({-0.5, 1.5, 1.2}), CellState::Unknown) << "outside";
    EXPECT_TRUE(space.openingReport().isClosed());
    // 4 x 3 x 2.6 m minus the camera's radius on all sides, the sofa and the table top.
    const double expected = 3.8 * 2.8 * 2.4 - 0.9 * 2.0 * 0.7 - 0.9 * 1.6 * 0.24;
    EXPECT_NEAR(space.rooms()[0].volume_m3, expected, 0.05 * expected);
    EXPECT_NEAR(space.rooms()[0].floor_area_m2, 3.8 * 2.8, 0.6);
    EXPECT_EQ(space.componentAt(space.rooms()[0].sample), 0);
}

TEST(FreeSpace, AnswersOutsideTheMapAndForNonsense) {
    const FreeSpace space = map(test::furnishedRoom());
    for (const Vector3d& p : {Vector3d(1e9, 0, 0), Vector3d(0, -1e300, 0),
                              Vector3d(0, 0, std::numeric_limits<double>::quiet_NaN())}) {
        EXPECT_EQ(space.stateAt(p), CellState::Unknown);
        EXPECT_EQ(space.componentAt(p), -1);
        EXPECT_EQ(space.clearanceLowerBound(p), 0.0);
        EXPECT_FALSE(space.inOneFreeLeaf(p, p));
    }
}

class Clearance : public testing::TestWithParam<double> {};

TEST_P(Clearance, IsNeverMoreThanTheTrueDistanceAndNotMuchLess) {
    const double resolution = GetParam();
    for (const Scene& scene : {test::furnishedRoom(), test::twoRoomsWithDoor(0.7)}) {
        const RayCaster rays(scene);
        const FreeSpace space = map(scene, resolution);
        Random random(3);
        const Eigen::AlignedBox3d box = space.bounds();
        int free = 0;
        for (int i = 0; i < 5000; ++i) {
            const Vector3d p(random.uniform(box.min().x(), box.max().x()),
                             random.uniform(box.min().y(), box.max().y()),
                             random.uniform(box.min().z(), box.max().z()));
            const double clearance = space.clearanceLowerBound(p);
            const double distance = rays.closest(p).distance;
            ASSERT_LE(clearance, distance) << p.transpose();
            if (space.stateAt(p) != CellState::Free) {
                ASSERT_EQ(clearance, 0.0);
                continue;
            }
            ++free;
            // The diagonals of two cells: that of the point and that of the surface.
            ASSERT_GE(clearance, distance - 2.0 * std::sqrt(3.0) * resolution - 1e-3);
        }
        EXPECT_GT(free, 1000);
    }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, Clearance, testing::Values(0.03, 0.05, 0.2));

TEST(FreeSpace, ClearanceKnowsOfSurfacesOutsideTheMap) {
    // The map ends within the room, and a wall stands beyond its rim.
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.5}).object("beyond").quad({3.7, 0, 0}, {0, 3, 0}, {0, 0, 2.5});
    Scene scene = builder.build();
    scene.room_bounds.max().x() = 3.5;
    const RayCaster rays(scene);
    const FreeSpace space = map(scene);
    Random random(4);
    for (int i = 0; i < 3000; ++i) {
        const Vector3d p(random.uniform(2, 3.5), random.uniform(0, 3), random.uniform(0, 2.5));
        ASSERT_LE(space.clearanceLowerBound(p), rays.closest(p).distance) << p.transpose();
    }
    EXPECT_GT(space.clearanceLowerBound({3.4, 1.5, 1.25}), 0.1);
}

TEST(FreeSpace, RoomCellsHoldTheSphereExactly) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    for (const double resolution : {0.05, 0.1, 0.2}) {
        const FreeSpace space = map(scene, resolution, 0.13);
        for (const Eigen::Vector3f& cell : space.cells(0)) {
            const Vector3d center = cell.cast<double>();
            ASSERT_EQ(space.componentAt(center), 0);
            ASSERT_EQ(space.stateAt(center), CellState::Free);
            ASSERT_GE(rays.closest(center).distance, 0.13 - 1e-6);
        }
        // No position that fits is missing, in a room where all positions are connected.
        int missed = 0;
        Random random(1);
        for (int i = 0; i < 3000; ++i) {
            Vector3d p(random.uniform(0, 4), random.uniform(0, 3), random.uniform(0, 2.6));
            p = ((p / resolution).array().floor() + 0.5) * resolution;
            if (space.stateAt(p) != CellState::Free) continue;
            if (rays.closest(p).distance >= 0.13 + 1e-6 && space.componentAt(p) != 0) ++missed;
        }
        EXPECT_EQ(missed, 0) << resolution;
    }
}

// The inner cells of the tree: every cell is looked up once with OctoMap's own search.
TEST(FreeSpace, OctreeHoldsTheStateOfEveryCell) {
    const FreeSpace space = map(test::furnishedRoom(), 0.1);
    const octomap::OcTree& tree = space.octree();
    const Eigen::AlignedBox3d box = space.bounds();
    std::array<int, 3> seen = {};
    for (double z = box.min().z() + 0.05; z < box.max().z(); z += 0.1) {
        for (double y = box.min().y() + 0.05; y < box.max().y(); y += 0.1) {
            for (double x = box.min().x() + 0.05; x < box.max().x(); x += 0.1) {
                const octomap::OcTreeNode* node = tree.search(x, y, z);
                const CellState state = !node                       ? CellState::Unknown
                                        : tree.isNodeOccupied(node) ? CellState::Occupied
                                                                    : CellState::Free;
                ASSERT_EQ(state, space.stateAt({x, y, z})) << x << " " << y << " " << z;
                ++seen[static_cast<unsigned>(state)];
            }
        }
    }
    for (const int count : seen) EXPECT_GT(count, 300);
    EXPECT_EQ(tree.size(), tree.calcNumNodes()) << "the tree counts its own nodes";
}

TEST(FreeSpace, LeavesAreAsLargeAsTheyCanBeAndTileTheSpace) {
    const FreeSpace space = map(test::furnishedRoom(), 0.05);
    double free_volume = 0.0;
    double largest = 0.0;
    std::size_t leaves = 0;
    space.visitLeaves([&](const FreeSpaceLeaf& leaf) {
        ++leaves;
        ASSERT_EQ(space.stateAt(leaf.center), leaf.state);
        ASSERT_NEAR(space.cellSizeAt(leaf.center), leaf.size_m, 1e-9);
        ASSERT_NEAR(leaf.size_m, std::ldexp(0.05, leaf.level), 1e-9);
        if (leaf.state != CellState::Free) return;
        free_volume += std::pow(leaf.size_m, 3);
        largest = std::max(largest, leaf.size_m);
        const double near_corner = 0.499 * leaf.size_m;
        const Vector3d corner = leaf.center + Vector3d::Constant(near_corner);
        ASSERT_TRUE(space.inOneFreeLeaf(leaf.center - Vector3d::Constant(near_corner), corner));
        ASSERT_FALSE(
            space.inOneFreeLeaf(corner, corner + Vector3d(0.01 * leaf.size_m + 0.002, 0, 0)));
    });
    EXPECT_GE(largest, 0.8);
    // 4 x 3 x 2.6 m minus one cell at each side and the furniture.
    EXPECT_NEAR(free_volume, 3.9 * 2.9 * 2.5 - 0.85 * 1.9 * 0.75 - 0.9 * 1.5 * 0.1, 0.5);
    const Vector3d cells = space.bounds().sizes() / 0.05;
    EXPECT_LT(static_cast<double>(leaves), 0.3 * cells.prod());
}

TEST(FreeSpace, IsTheSameWithAnyNumberOfThreads) {
    const Scene scene = test::twoRoomsWithDoor(0.7);
    const auto fingerprint = [&](int threads) {
        setThreadCount(threads);
        const FreeSpace space = map(scene);
        std::ostringstream bytes;
        space.octree().write(bytes);
        Random random(9);
        for (int i = 0; i < 20'000; ++i) {
            const Vector3d p(random.uniform(-0.2, 6.3), random.uniform(-0.2, 3.2),
                             random.uniform(-0.2, 2.7));
            bytes << space.clearanceLowerBound(p) << space.componentAt(p) << space.cellSizeAt(p);
        }
        for (const Eigen::Vector3f& cell : space.cells(0)) {
            bytes.write(reinterpret_cast<const char*>(cell.data()), sizeof(float) * 3);
        }
        setThreadCount(0);
        return bytes.str();
    };
    const std::string alone = fingerprint(1);
    EXPECT_EQ(alone, fingerprint(2));
    EXPECT_EQ(alone, fingerprint(0));
}

TEST(FreeSpace, StopsWhenCancelled) {
    const Scene scene = test::furnishedRoom();
    const auto flag = std::make_shared<const std::atomic<bool>>(true);
    const Result<FreeSpace> result =
        FreeSpace::build(scene, RayCaster(scene), {}, {}, JobContext(flag, nullptr));
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
}

TEST(FreeSpace, SaysWhenTheCameraFitsNowhere) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {0.5, 0.5, 0.5});
    const Result<FreeSpace> result = tryMap(builder.build(), 0.05, 0.3);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::BadInput);
    EXPECT_NE(result.error().message.find("camera_radius_m"), std::string::npos);
}

TEST(FreeSpace, RefusesBoundsItCannotMap) {
    Scene scene = test::furnishedRoom();
    scene.room_bounds.setEmpty();
    EXPECT_EQ(tryMap(scene).error().code, ErrorCode::BadInput);
    scene = test::furnishedRoom();
    scene.room_bounds.max().x() = std::numeric_limits<double>::infinity();
    EXPECT_EQ(tryMap(scene).error().code, ErrorCode::BadInput);
    EXPECT_EQ(tryMap(test::furnishedRoom(), 0.0).error().where, "octree_resolution_m");
    EXPECT_EQ(tryMap(test::furnishedRoom(), 0.05, -1.0).error().where, "camera_radius_m");
}

TEST(FreeSpace, CellsToSampleFromAreThinnedEvenly) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 5, 4});
    const FreeSpace space = map(builder.build(), 0.04);
    const std::size_t count = space.cells(0).size();
    EXPECT_GT(space.rooms()[0].volume_m3 / std::pow(0.04, 3), 1.2 * (1 << 19U));
    EXPECT_LT(count, 1.1 * (1 << 19U));
    Vector3d mean = Vector3d::Zero();
    for (const Eigen::Vector3f& cell : space.cells(0)) mean += cell.cast<double>();
    mean /= static_cast<double>(count);
    EXPECT_LT((mean - Vector3d(3, 2.5, 2)).norm(), 0.05);
}

}  // namespace dollytrack::planning::free_space_test
