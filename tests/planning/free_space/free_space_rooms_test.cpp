// Where rooms end: cases that occur in real scenes.

#include "planning/free_space/opening_summary.h"
#include "tests/planning/support/map_support.h"

#include <gtest/gtest.h>

namespace dollytrack::planning::free_space_rooms_test {

using Eigen::Vector3d;
using test::SceneBuilder;
using test_support::kFloorLook;
using test_support::kSofaLook;
using test_support::kWallLook;
using test_support::map;

namespace {

bool hasOpening(const FreeSpace& space, OpeningKind kind, const Vector3d& outwards) {
    for (const Opening& opening : space.openingReport().openings) {
        if (opening.kind == kind && opening.outwards.dot(outwards) > 0.9) return true;
    }
    return false;
}

std::string allOpenings(const FreeSpace& space) {
    std::string text;
    for (const Opening& opening : space.openingReport().openings) text += describe(opening) + "\n";
    return text;
}

/// A wall as a thin box from a to b, with a rectangular hole `from`..`to` along it when given.
void addWall(SceneBuilder& builder, const Vector3d& a, const Vector3d& b, double height_m,
             double hole_from = 0.0, double hole_to = 0.0, double sill_m = 0.0,
             double lintel_m = 2.0) {
    const Vector3d along = (b - a).normalized();
    const double length = (b - a).norm();
    const auto piece = [&](double from, double to, double low, double high) {
        if (to - from < 1e-6 || high - low < 1e-6) return;
        const Vector3d center = a + along * 0.5 * (from + to) + Vector3d(0, 0, 0.5 * (low + high));
        builder.box(center, {to - from, 0.1, high - low}, std::atan2(along.y(), along.x()));
    };
    builder.object("wall", kWallLook);
    piece(0, hole_from, 0, height_m);
    piece(hole_to, length, 0, height_m);
    if (hole_to > hole_from) {
        piece(hole_from, hole_to, 0, sill_m);
        piece(hole_from, hole_to, lintel_m, height_m);
    }
}

/// An L-shaped house of two wings without ceiling; the notch is x > 5, y > 5.
SceneBuilder lShapedHouse(bool with_floor) {
    SceneBuilder builder;
    const double h = 2.5;
    addWall(builder, {0, 0, 0}, {10, 0, 0}, h);
    addWall(builder, {10, 0, 0}, {10, 5, 0}, h);
    addWall(builder, {5, 5, 0}, {10, 5, 0}, h, 1.0, 1.9);            // a door to the garden
    addWall(builder, {5, 5, 0}, {5, 10, 0}, h, 1.0, 2.5, 0.9, 2.1);  // a window without glass
    addWall(builder, {0, 10, 0}, {5, 10, 0}, h);
    addWall(builder, {0, 0, 0}, {0, 10, 0}, h);
    addWall(builder, {0, 5, 0}, {5, 5, 0}, h, 2.0, 2.8);
    if (with_floor) {
        builder.object("floor", kFloorLook).quad({0, 0, 0}, {10, 0, 0}, {0, 5, 0});
        builder.quad({0, 5, 0}, {5, 0, 0}, {0, 5, 0});
    }
    builder.object("table", kSofaLook).box({8, 2, 0.4}, {1.2, 0.8, 0.8});
    return builder;
}

}  // namespace

TEST(FreeSpaceRooms, ARoomWithoutCeilingEndsAtTheSceneBox) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.5}, false)
        .object("sofa", kSofaLook)
        .box({1, 1, 0.4}, {1, 1, 0.8});
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_EQ(space.stateAt({2, 2, 2.4}), CellState::Free);
    EXPECT_EQ(space.stateAt({1, 1, 0.4}), CellState::Unknown);
    EXPECT_EQ(space.stateAt({2, 2, 2.7}), CellState::Unknown);
    ASSERT_EQ(space.openingReport().openings.size(), 1U) << allOpenings(space);
    const Opening& opening = space.openingReport().openings[0];
    EXPECT_EQ(opening.kind, OpeningKind::NoCeiling);
    EXPECT_TRUE(opening.at_scene_box);
    EXPECT_NEAR(opening.area_m2, 12.0, 1.0);
    EXPECT_NEAR((opening.center_in_world - Vector3d(2, 1.5, 2.5)).norm(), 0.0, 0.1);
}

TEST(FreeSpaceRooms, ARoomWithAMissingWallIsFreeUpToTheSceneBox) {
    for (const bool ceiling : {true, false}) {
        SceneBuilder builder;
        builder.object("floor", kFloorLook).quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
        builder.object("wall_north", kWallLook).quad({0, 3, 0}, {4, 0, 0}, {0, 0, 2.5});
        builder.object("wall_west", kWallLook).quad({0, 0, 0}, {0, 3, 0}, {0, 0, 2.5});
        builder.object("wall_east", kWallLook).quad({4, 0, 0}, {0, 3, 0}, {0, 0, 2.5});
        if (ceiling) builder.object("ceiling", kWallLook).quad({0, 0, 2.5}, {4, 0, 0}, {0, 3, 0});
        const FreeSpace space = map(builder.build());
        ASSERT_EQ(space.rooms().size(), 1U);
        for (const double x : {0.2, 2.0, 3.8}) {
            for (const double y : {0.1, 1.5, 2.8}) {
                EXPECT_EQ(space.stateAt({x, y, 1.2}), CellState::Free) << x << " " << y;
            }
        }
        EXPECT_EQ(space.stateAt({2.0, -0.3, 1.2}), CellState::Unknown);
        EXPECT_TRUE(hasOpening(space, OpeningKind::MissingWall, {0, -1, 0})) << allOpenings(space);
        EXPECT_EQ(hasOpening(space, OpeningKind::NoCeiling, {0, 0, 1}), !ceiling)
            << allOpenings(space);
    }
}

TEST(FreeSpaceRooms, ADollHouseOfTwoWallsAndAFloorIsARoom) {
    SceneBuilder builder;
    builder.object("floor", kFloorLook).quad({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    builder.object("wall_north", kWallLook).quad({0, 4, 0}, {4, 0, 0}, {0, 0, 2.5});
    builder.object("wall_west", kWallLook).quad({0, 0, 0}, {0, 4, 0}, {0, 0, 2.5});
    builder.object("sofa", kSofaLook).box({1, 3, 0.4}, {1, 1, 0.8});
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_GT(space.rooms()[0].volume_m3, 0.6 * 4 * 4 * 2.5);
    EXPECT_EQ(space.stateAt({2, 2, 1.2}), CellState::Free);
    EXPECT_EQ(space.stateAt({1, 3, 0.4}), CellState::Unknown);
}

// From its roomiest place, at the open corner, hardly a ray meets anything.
TEST(FreeSpaceRooms, ASmallDollHouseIsARoomToo) {
    SceneBuilder builder;
    builder.object("floor", kFloorLook).quad({0, 0, 0}, {2.4, 0, 0}, {0, 2.4, 0});
    builder.object("wall_north", kWallLook).quad({0, 2.4, 0}, {2.4, 0, 0}, {0, 0, 2.2});
    builder.object("wall_west", kWallLook).quad({0, 0, 0}, {0, 2.4, 0}, {0, 0, 2.2});
    for (int i = 0; i < 4; ++i) {
        builder.object("sofa", kSofaLook).box({0.4, 0.4 + 0.5 * i, 0.4}, {0.6, 0.4, 0.8});
    }
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_EQ(space.stateAt({1.5, 1.5, 1.2}), CellState::Free);
}

TEST(FreeSpaceRooms, FurnitureAloneIsNoRoom) {
    SceneBuilder builder;
    builder.object("sofa", kSofaLook).box({1, 1, 0.4}, {1, 1, 0.8});
    builder.object("shelf", kSofaLook).box({2.2, 1, 1}, {0.8, 0.4, 2});
    const Scene scene = builder.build();
    const auto space = FreeSpace::build(scene, RayCaster(scene), CameraParams{}, FreeSpaceParams{});
    ASSERT_FALSE(space);
    EXPECT_NE(space.error().message.find("no object is a floor, wall or ceiling"), std::string::npos)
        << space.error().message;
}

TEST(FreeSpaceRooms, RoomsJoinedByADoorAreOne) {
    const FreeSpace open = map(test::twoRoomsWithDoor(0.6));
    ASSERT_EQ(open.rooms().size(), 1U);
    EXPECT_EQ(open.componentAt({1, 1.5, 1}), open.componentAt({5, 1.5, 1}));
    const FreeSpace coarse = map(test::twoRoomsWithDoor(0.6), 0.2);
    EXPECT_EQ(coarse.rooms().size(), 1U);
}

TEST(FreeSpaceRooms, ADoorNarrowerThanTheCameraSeparates) {
    const FreeSpace space = map(test::twoRoomsWithDoor(0.6), 0.05, 0.32);
    ASSERT_EQ(space.rooms().size(), 2U);
    EXPECT_EQ(space.stateAt({3.05, 1.5, 1.0}), CellState::Free) << "air is still free in the door";
    EXPECT_EQ(space.componentAt({3.05, 1.5, 1.0}), -1);
}

TEST(FreeSpaceRooms, ClosedDoorsMakeRoomsOfTheirOwn) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 3, 2.5});
    addWall(builder, {4, 0, 0}, {4, 3, 0}, 2.5, 1.0, 1.9);
    builder.object("door", {kNyuDoor, Role::Structure, {0.6F, 0.4F, 0.2F}})
        .box({4, 1.45, 1}, {0.04, 0.9, 2.0});
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 2U);
    EXPECT_GT(space.rooms()[0].volume_m3, space.rooms()[1].volume_m3);
    EXPECT_EQ(space.componentAt({2, 1.5, 1}), 0);
    EXPECT_EQ(space.componentAt({5, 1.5, 1}), 1);
    EXPECT_TRUE(space.openingReport().isClosed()) << allOpenings(space);
}

TEST(FreeSpaceRooms, HollowFurnitureIsSealedAndOpenFurnitureIsNot) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {5, 4, 2.6});
    // A closed wardrobe large enough to stand in, one without back or floor at the wall, and one
    // with its doors open.
    builder.object("closed", {3, Role::Target, {0.5F, 0.4F, 0.3F}})
        .box({1.2, 0.5, 1.15}, {2, 0.8, 2.2});
    builder.object("backless", {3, Role::Target, {0.5F, 0.4F, 0.3F}})
        .quad({0, 2, 2.2}, {0.8, 0, 0}, {0, 1.6, 0})
        .quad({0, 2, 0}, {0.8, 0, 0}, {0, 0, 2.2})
        .quad({0, 3.6, 0}, {0.8, 0, 0}, {0, 0, 2.2})
        .quad({0.8, 2, 0}, {0, 1.6, 0}, {0, 0, 2.2});
    builder.object("open", {3, Role::Target, {0.5F, 0.4F, 0.3F}})
        .quad({4.4, 2, 2.2}, {0.6, 0, 0}, {0, 1.6, 0})
        .quad({4.4, 2, 0.05}, {0.6, 0, 0}, {0, 1.6, 0})
        .quad({4.4, 2, 0}, {0.6, 0, 0}, {0, 0, 2.2})
        .quad({4.4, 3.6, 0}, {0.6, 0, 0}, {0, 0, 2.2});
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_EQ(space.stateAt({1.2, 0.5, 1.2}), CellState::Unknown);
    EXPECT_EQ(space.stateAt({0.4, 2.8, 1.2}), CellState::Unknown);
    EXPECT_EQ(space.stateAt({4.7, 2.8, 1.2}), CellState::Free);
    EXPECT_EQ(space.componentAt({4.7, 2.8, 1.2}), 0);
}

TEST(FreeSpaceRooms, AHollowBehindANarrowSlitIsNotEntered) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 4, 2.6});
    // A sofa whose front ends 0.12 m above the floor: air gets in, a camera does not.
    builder.object("sofa", kSofaLook)
        .quad({1, 1, 0.8}, {2, 0, 0}, {0, 1, 0})
        .quad({1, 1, 0.12}, {2, 0, 0}, {0, 0, 0.68})
        .quad({1, 2, 0}, {2, 0, 0}, {0, 0, 0.8})
        .quad({1, 1, 0}, {0, 1, 0}, {0, 0, 0.8})
        .quad({3, 1, 0}, {0, 1, 0}, {0, 0, 0.8});
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_EQ(space.componentAt({2, 1.5, 0.4}), -1);
    EXPECT_EQ(space.stateAt({2, 1.5, 0.4}), CellState::Unknown);
}

TEST(FreeSpaceRooms, TheNotchOfAnLShapedHouseIsOutside) {
    for (const bool with_floor : {true, false}) {
        for (const bool ground : {true, false}) {
            SceneBuilder builder = lShapedHouse(with_floor);
            Scene house = builder.build();
            const Eigen::AlignedBox3d bounds = house.room_bounds;
            if (ground) {
                builder.object("ground", kFloorLook).quad({-8, -8, -0.01}, {26, 0, 0}, {0, 26, 0});
                house = builder.build();
                house.room_bounds = bounds;
            }
            const FreeSpace space = map(house);
            ASSERT_EQ(space.rooms().size(), 1U) << with_floor << ground;
            for (const Vector3d& p : {Vector3d(2, 2, 1),
                                      {8, 4, 1.5},
                                      {2, 8, 1},
                                      {4.7, 6.7, 1.4},
                                      {6.4, 4.7, 1.0},
                                      {2.4, 5, 1},
                                      {9.5, 0.5, 2.3}}) {
                EXPECT_EQ(space.stateAt(p), CellState::Free)
                    << p.transpose() << " " << with_floor << ground;
            }
            for (const Vector3d& p : {Vector3d(7.5, 7.5, 1),
                                      {5.4, 5.4, 0.5},
                                      {9.5, 5.5, 1.5},
                                      {6.4, 5.8, 1.0},
                                      {5.8, 6.7, 1.4},
                                      {9.8, 9.8, 2}}) {
                EXPECT_NE(space.stateAt(p), CellState::Free)
                    << p.transpose() << " " << with_floor << ground;
            }
            EXPECT_NEAR(space.rooms()[0].floor_area_m2, 3 * 4.7 * 4.7 + 0.5, 4.0);
            EXPECT_TRUE(hasOpening(space, OpeningKind::NoCeiling, {0, 0, 1})) << allOpenings(space);
        }
    }
}

TEST(FreeSpaceRooms, ARectangularSlabUnderAnLShapedHouseDoesNotMakeItsNotchARoom) {
    SceneBuilder builder = lShapedHouse(false);
    builder.object("slab", kFloorLook).quad({0, 0, 0}, {10, 0, 0}, {0, 10, 0});
    const FreeSpace space = map(builder.build());
    EXPECT_EQ(space.stateAt({2, 8, 1}), CellState::Free);
    EXPECT_NE(space.stateAt({7.5, 7.5, 1}), CellState::Free);
}

TEST(FreeSpaceRooms, AHugeGroundPlaneAndADomeChangeNothing) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.5}, false);
    const Scene alone = builder.build();
    builder.object("ground", {kNyuFloor, Role::Structure, {0.4F, 0.4F, 0.4F}})
        .quad({-100, -100, -0.02}, {200, 0, 0}, {0, 200, 0});
    builder.object("dome", {0, Role::Structure, {0.4F, 0.6F, 1.0F}})
        .box({0, 0, 0}, {200, 200, 200});
    Scene surrounded = builder.build();
    surrounded.room_bounds = alone.room_bounds;
    const FreeSpace a = map(alone);
    const FreeSpace b = map(surrounded);
    ASSERT_EQ(b.rooms().size(), 1U);
    EXPECT_NEAR(a.rooms()[0].volume_m3, b.rooms()[0].volume_m3, 0.05 * a.rooms()[0].volume_m3);
    EXPECT_EQ(b.stateAt({2, 1.5, 2.4}), CellState::Free);
    EXPECT_EQ(b.stateAt({2, 1.5, 2.7}), CellState::Unknown);
    EXPECT_GT(b.clearanceLowerBound({2, 1.5, 1.2}), 1.0);
}

TEST(FreeSpaceRooms, TheAirAboveARooflessHouseIsOutside) {
    SceneBuilder builder;
    builder.room({0, 0, 0}, {5, 4, 2.5}, false);
    builder.object("antenna", kSofaLook).box({4.5, 3.5, 2.2}, {0.05, 0.05, 4.4});
    const FreeSpace space = map(builder.build());
    EXPECT_EQ(space.stateAt({2, 2, 2.3}), CellState::Free);
    EXPECT_NE(space.stateAt({2, 2, 3.0}), CellState::Free);
    EXPECT_TRUE(hasOpening(space, OpeningKind::NoCeiling, {0, 0, 1})) << allOpenings(space);
}

TEST(FreeSpaceRooms, TheSpaceUnderARaisedFloorIsOutside) {
    SceneBuilder builder;
    builder.room({0, 0, 1}, {5, 4, 3.5});
    for (const double x : {0.1, 4.9}) {
        builder.object("post", kWallLook).box({x, 0.1, 0.5}, {0.2, 0.2, 1.0});
        builder.object("post", kWallLook).box({x, 3.9, 0.5}, {0.2, 0.2, 1.0});
    }
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_NE(space.stateAt({2.5, 2, 0.5}), CellState::Free);
}

TEST(FreeSpaceRooms, ATurnedHouseLeavesTheCornersOfItsBoxOutside) {
    SceneBuilder builder;
    addWall(builder, {0, 4, 0}, {4, 0, 0}, 2.5);
    addWall(builder, {4, 0, 0}, {8, 4, 0}, 2.5, 1.0, 1.9);
    addWall(builder, {8, 4, 0}, {4, 8, 0}, 2.5, 1.0, 3.0, 0.8, 2.0);
    addWall(builder, {4, 8, 0}, {0, 4, 0}, 2.5);
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_EQ(space.stateAt({4, 4, 1.2}), CellState::Free);
    EXPECT_EQ(space.stateAt({4.5, 7, 1.4}), CellState::Free);
    for (const Vector3d& corner :
         {Vector3d(0.7, 0.7, 1), {7.3, 0.7, 1}, {7.3, 7.3, 1.4}, {0.7, 7.3, 1}}) {
        EXPECT_NE(space.stateAt(corner), CellState::Free) << corner.transpose();
    }
    EXPECT_NEAR(space.rooms()[0].floor_area_m2, 5.36 * 5.36, 1.5);
}

TEST(FreeSpaceRooms, AWindowWithoutGlassIsReportedWhereItIs) {
    SceneBuilder builder;
    builder.object("floor", kFloorLook).quad({0, 0, 0}, {5, 0, 0}, {0, 4, 0});
    builder.object("ceiling", kWallLook).quad({0, 0, 2.5}, {5, 0, 0}, {0, 4, 0});
    addWall(builder, {0, 0, 0}, {5, 0, 0}, 2.5, 1.5, 3.0, 0.9, 2.1);
    addWall(builder, {5, 0, 0}, {5, 4, 0}, 2.5);
    addWall(builder, {5, 4, 0}, {0, 4, 0}, 2.5);
    addWall(builder, {0, 4, 0}, {0, 0, 0}, 2.5);
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.openingReport().openings.size(), 1U) << allOpenings(space);
    const Opening& hole = space.openingReport().openings[0];
    EXPECT_EQ(hole.kind, OpeningKind::Hole);
    EXPECT_EQ(hole.outwards, Vector3d(0, -1, 0));
    EXPECT_NEAR(hole.area_m2, 1.5 * 1.2, 0.3);
    EXPECT_LT((hole.center_in_world - Vector3d(2.25, 0, 1.5)).norm(), 0.15);
}

TEST(FreeSpaceRooms, OpeningsOfOneKindOnOneSideAreDescribedInOneSentence) {
    OpeningReport report;
    for (int i = 0; i < 69; ++i) {
        report.openings.push_back(
            {OpeningKind::Hole, 0, {1, 0, 0}, {4.0, 0.5 * i, 1.5}, i == 3 ? 2.0 : 0.5, true});
    }
    report.openings.push_back({OpeningKind::Hole, 0, {0, 1, 0}, {2.0, 3.0, 1.5}, 0.7, true});
    report.openings.push_back({OpeningKind::Hole, 1, {1, 0, 0}, {9.0, 3.0, 1.5}, 0.9, true});
    EXPECT_EQ(describeAll(report),
              (std::vector<std::string>{
                  "Room 1 is open towards its +x side at 69 openings (36.0 m2 in total; the "
                  "largest has 2.0 m2 around 4.0, 1.5, 1.5)",
                  describe(report.openings[69]), describe(report.openings[70])}));
}

// A yard between two wings of a house without floor and ceiling, and a low wall in front of a room.
TEST(FreeSpaceRooms, AYardWithThreeWallsIsOutsideButTheRoomBehindItsLowWallIsNot) {
    SceneBuilder builder;
    addWall(builder, {0, 10, 0}, {16, 10, 0}, 2.5);
    addWall(builder, {0, 0, 0}, {0, 10, 0}, 2.5);
    addWall(builder, {16, 0, 0}, {16, 10, 0}, 2.5);
    addWall(builder, {3, 0, 0}, {3, 10, 0}, 2.5, 7.0, 8.0);
    addWall(builder, {13, 0, 0}, {13, 10, 0}, 2.5, 7.0, 8.0);
    addWall(builder, {0, 0, 0}, {3, 0, 0}, 2.5);
    addWall(builder, {13, 0, 0}, {16, 0, 0}, 2.5);
    addWall(builder, {3, 5, 0}, {13, 5, 0}, 1.0, 2.5, 3.5, 0.0, 1.0);
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    for (const Vector3d& p : {Vector3d(1.5, 5, 1), {14.5, 5, 1.5}, {6, 8, 0.5}, {6, 8, 2.2}}) {
        EXPECT_EQ(space.stateAt(p), CellState::Free) << p.transpose();
    }
    for (const Vector3d& p : {Vector3d(8, 1, 1), {9, 3, 2.2}, {11, 2, 0.3}}) {
        EXPECT_NE(space.stateAt(p), CellState::Free) << p.transpose();
    }
}

TEST(FreeSpaceRooms, ATerraceIsARoomOnlyWhenFurnitureStandsOnIt) {
    for (const bool furnished : {true, false}) {
        SceneBuilder builder;
        addWall(builder, {0, 0, 0}, {6, 0, 0}, 2.5);
        addWall(builder, {0, 4, 0}, {6, 4, 0}, 2.5, 2.5, 3.4);
        addWall(builder, {0, 0, 0}, {0, 9, 0}, 2.5);
        addWall(builder, {6, 0, 0}, {6, 4, 0}, 2.5);
        builder.object("post", kWallLook).box({5.95, 8.95, 1.25}, {0.1, 0.1, 2.5});
        if (furnished) {
            builder.object("sofa", kSofaLook).box({2, 7, 0.4}, {2.2, 1.0, 0.8});
            builder.object("table", kSofaLook).box({4, 7, 0.35}, {1.4, 1.0, 0.7});
        }
        Scene scene = builder.build();
        const Eigen::AlignedBox3d bounds = scene.room_bounds;
        builder.object("ground", kFloorLook).quad({-10, -10, 0}, {26, 0, 0}, {0, 29, 0});
        scene = builder.build();
        scene.room_bounds = bounds;
        const FreeSpace space = map(scene);
        EXPECT_EQ(space.stateAt({3, 2, 1.2}), CellState::Free);
        EXPECT_EQ(space.stateAt({3, 6, 1.2}) == CellState::Free, furnished);
        EXPECT_EQ(space.stateAt({2, 7, 0.4}) == CellState::Free, false);
    }
}

TEST(FreeSpaceRooms, AirOverACupboardAtAnOuterWallIsTheRooms) {
    SceneBuilder builder;
    builder.object("floor", kFloorLook).quad({-1, -1, 0}, {7, 0, 0}, {0, 7, 0});
    addWall(builder, {0, 0, 0}, {5, 0, 0}, 2.5);
    addWall(builder, {5, 0, 0}, {5, 5, 0}, 2.5);
    addWall(builder, {5, 5, 0}, {0, 5, 0}, 2.5);
    addWall(builder, {0, 5, 0}, {0, 0, 0}, 2.5);
    builder.object("ceiling", kWallLook).quad({0, 0, 2.5}, {5, 0, 0}, {0, 5, 0});
    builder.object("cupboard", kSofaLook).box({2.5, 0.4, 0.9}, {3.0, 0.7, 1.8});
    const FreeSpace space = map(builder.build());
    EXPECT_EQ(space.componentAt({2.5, 0.4, 2.1}), 0);
    EXPECT_EQ(space.stateAt({2.5, 0.4, 0.9}), CellState::Unknown);
    EXPECT_NE(space.stateAt({2.5, -0.5, 1.0}), CellState::Free);
    EXPECT_TRUE(space.openingReport().isClosed()) << allOpenings(space);
}

// A scene that is one unnamed mesh: its shell must not be taken for furniture.
TEST(FreeSpaceRooms, ARoomThatIsOneTargetObjectIsStillARoom) {
    SceneBuilder builder;
    builder.object("mesh").box({1.5, 1.5, 1.25}, {3, 3, 2.5});
    const FreeSpace space = map(builder.build());
    ASSERT_EQ(space.rooms().size(), 1U);
    EXPECT_EQ(space.stateAt({1.5, 1.5, 1.2}), CellState::Free);
}

}  // namespace dollytrack::planning::free_space_rooms_test
