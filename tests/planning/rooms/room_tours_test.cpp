#include "engine/geometry/ray_caster.h"
#include "engine/plan/plan_json.h"
#include "planning/free_space/free_space.h"
#include "planning/rooms/room_plan.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace dollytrack::planning::room_tours_test {
namespace {

using test_support::planOf;

constexpr double kWall_x = 3.05;  // of the wall between the two rooms

RoomPlan roomPlanOf(const Scene& scene) {
    const RayCaster rays(scene);
    const PlanParams params;
    const auto map = FreeSpace::build(scene, rays, params.camera, params.free_space);
    EXPECT_TRUE(map.has_value());
    return {scene, rays, *map, params.camera.camera_radius_m};
}

const test::SceneBuilder::Look kWallLook = {kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}};

/// A corridor of 7 x 1.3 m with a room of 4 x 3 m at its side, joined by a door 0.9 m wide, and one
/// of 2.9 x 3 m without a door.
Scene roomAtACorridor() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {7, 4.4, 2.5});
    builder.object("wall", kWallLook)
        .box({1.0, 1.35, 1.25}, {2.0, 0.1, 2.5})
        .box({4.95, 1.35, 1.25}, {4.1, 0.1, 2.5})
        .box({2.45, 1.35, 2.25}, {0.9, 0.1, 0.5})
        .box({4.05, 2.9, 1.25}, {0.1, 3.0, 2.5});
    builder.object("cube").box({1.0, 3.5, 0.25}, {0.5, 0.5, 0.5});
    builder.object("vase").box({6.6, 0.3, 0.2}, {0.2, 0.2, 0.4});
    return builder.build();
}

}  // namespace

TEST(RoomPlan, FindsTheDoorBetweenTwoRooms) {
    for (const double width : {0.7, 1.0, 1.5}) {
        const RoomPlan plan = roomPlanOf(test::twoRoomsWithDoor(width));
        ASSERT_EQ(plan.rooms().size(), 2U) << width;
        ASSERT_EQ(plan.doorways().size(), 1U) << width;
        const Doorway& door = plan.doorways()[0];
        EXPECT_NEAR(door.center.x(), kWall_x, 0.1);
        EXPECT_NEAR(door.center.y(), 1.5, 0.1);
        EXPECT_NEAR(std::abs(door.through.x()), 1.0, 0.05);
        EXPECT_LE(door.width_m, width + 1e-6);
        EXPECT_NE(plan.roomAt({1, 1, 1}), plan.roomAt({5, 1, 1}));
        EXPECT_EQ(plan.roomAt({1, 1, 1}), plan.roomAt({0.3, 2.7, 2}));
        // From room a into room b.
        const double side = plan.roomAt({1, 1, 1}) == door.room_a ? 1.0 : -1.0;
        EXPECT_GT(side * door.through.x(), 0.0);
    }
    EXPECT_TRUE(roomPlanOf(test::furnishedRoom()).doorways().empty());
}

TEST(RoomPlan, WalksThroughDoorwaysAndNotThroughWindows) {
    // An opening 2.2 m wide in the wall between two rooms, from a sill to a lintel.
    const auto rooms = [](double sill, double lintel) {
        test::SceneBuilder builder;
        builder.room({0, 0, 0}, {6.1, 3, 2.8});
        builder.object("wall", kWallLook)
            .box({3.05, 0.2, 1.4}, {0.1, 0.4, 2.8})
            .box({3.05, 2.8, 1.4}, {0.1, 0.4, 2.8})
            .box({3.05, 1.5, 0.5 * (lintel + 2.8)}, {0.1, 2.2, 2.8 - lintel});
        if (sill > 0.0) {
            builder.object("parapet", kWallLook).box({3.05, 1.5, 0.5 * sill}, {0.1, 2.2, sill});
        }
        builder.object("chest").box({1.0, 0.6, 0.25}, {0.5, 0.5, 0.5});
        return roomPlanOf(builder.build());
    };
    const RoomPlan door = rooms(0.0, 2.0);
    EXPECT_EQ(door.rooms().size(), 2U);
    ASSERT_EQ(door.doorways().size(), 1U);
    EXPECT_NEAR(door.doorways()[0].center.y(), 1.5, 0.1);
    const RoomPlan window = rooms(0.9, 2.0);
    EXPECT_EQ(window.rooms().size(), 2U);
    EXPECT_TRUE(window.doorways().empty());
    // No lintel: an open plan.
    EXPECT_EQ(rooms(0.0, 2.7).rooms().size(), 1U);
}

TEST(RoomPlan, TellsACorridorFromARoom) {
    const RoomPlan plan = roomPlanOf(roomAtACorridor());
    ASSERT_EQ(plan.rooms().size(), 3U);
    ASSERT_EQ(plan.doorways().size(), 1U);
    const PlanRoom& corridor = plan.rooms()[plan.roomAt({5, 0.6, 1})];
    const PlanRoom& room = plan.rooms()[plan.roomAt({2, 3, 1})];
    EXPECT_TRUE(corridor.corridor);
    EXPECT_FALSE(room.corridor);
    EXPECT_EQ(corridor.name.substr(0, 9), "corridor_");
    EXPECT_GT((corridor.far_end - corridor.near_end).norm(), 6.0);
    EXPECT_NEAR(plan.doorways()[0].center.x(), 2.45, 0.1);
}

TEST(RoomTours, EachRoomGetsItsOwn) {
    const Scene scene = test::twoRoomsWithDoor(0.9);
    PlanParams params;
    const auto joined = planOf(scene, params);
    EXPECT_EQ(joined->paths.size(), 1U);
    EXPECT_TRUE(joined->tour_rooms.empty());
    params.constraints.rooms = RoomTours::Each;
    for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
        params.path.path_mode = mode;
        const auto plan = planOf(scene, params);
        EXPECT_EQ(plan->capture_metrics.captured, joined->capture_metrics.captured);
        ASSERT_EQ(plan->tour_rooms.size(), 2U);
        for (const CameraPath& path : plan->paths) {
            const bool west = path.vertices.front().position.x() < kWall_x;
            for (const PathVertex& vertex : path.vertices) {
                EXPECT_EQ(vertex.position.x() < kWall_x, west);
            }
        }
        for (const TrajectoryFrame& frame : plan->trajectory.frames) {
            const CameraPath& path = plan->paths[frame.path];
            const bool west = plan->tour_rooms[path.room].box.center().x() < kWall_x;
            EXPECT_EQ(frame.pose.position.x() < kWall_x, west);
        }
        const auto rooms = metricsJson(scene, *plan)["rooms"];
        ASSERT_EQ(rooms.size(), 2U);
        EXPECT_EQ(rooms[0]["frames"].get<std::size_t>() + rooms[1]["frames"].get<std::size_t>(),
                  plan->trajectory.frames.size());
    }
}

// The shortest path from one side of the large room to the other is through the small one.
TEST(RoomTours, NoWayLeadsThroughAnotherRoom) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {7, 5.5, 2.5});
    builder.object("wall", kWallLook)
        .box({3.5, 3.05, 1.25}, {2.1, 0.1, 2.5})
        .box({2.5, 0.5, 1.25}, {0.1, 1.0, 2.5})
        .box({2.5, 2.45, 1.25}, {0.1, 1.1, 2.5})
        .box({4.5, 0.5, 1.25}, {0.1, 1.0, 2.5})
        .box({4.5, 2.45, 1.25}, {0.1, 1.1, 2.5});
    builder.object("west_box").box({0.5, 1.4, 0.25}, {0.5, 0.5, 0.5});
    builder.object("east_box").box({6.5, 1.4, 0.25}, {0.5, 0.5, 0.5});
    builder.object("inner_box").box({3.5, 2.7, 0.25}, {0.5, 0.5, 0.5});
    const Scene scene = builder.build();
    const auto isInside = [](const Eigen::Vector3d& p) {
        return p.x() > 2.6 && p.x() < 4.4 && p.y() < 3.0;
    };
    PlanParams params;
    params.shake.shake = ShakeKind::Handheld;
    params.constraints.rooms = RoomTours::Each;
    for (const int seed : {1, 2, 3}) {
        params.seed = seed;
        const auto plan = planOf(scene, params);
        EXPECT_EQ(plan->capture_metrics.captured, 3);
        ASSERT_EQ(plan->tour_rooms.size(), 2U);
        int inside = 0;
        for (const TrajectoryFrame& frame : plan->trajectory.frames) {
            const CameraPath& path = plan->paths[frame.path];
            EXPECT_EQ(isInside(frame.pose.position), path.room == 1);
            inside += isInside(frame.pose.position) ? 1 : 0;
        }
        EXPECT_GT(inside, 0);
        EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
    }
}

TEST(Anchors, TheTrajectoryGoesThroughEveryDoorway) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6.1, 3, 2.5});
    builder.object("wall_between", kWallLook)
        .box({3.05, 0.5, 1.25}, {0.1, 1.0, 2.5})
        .box({3.05, 2.45, 1.25}, {0.1, 1.1, 2.5})
        .box({3.05, 1.45, 2.25}, {0.1, 0.9, 0.5});
    builder.object("only_thing").box({1.0, 0.6, 0.25}, {0.5, 0.5, 0.5});
    const Scene scene = builder.build();
    const auto atTheDoor = [](const Plan& plan) {
        return std::any_of(plan.trajectory.frames.begin(), plan.trajectory.frames.end(),
                           [](const TrajectoryFrame& frame) {
                               return std::abs(frame.pose.position.x() - kWall_x) < 0.3 &&
                                      std::abs(frame.pose.position.y() - 1.45) < 0.2 &&
                                      std::abs(frame.pose.forward().x()) > 0.95;
                           });
    };
    PlanParams params;
    EXPECT_FALSE(atTheDoor(*planOf(scene, params)));
    for (const Anchors anchors : {Anchors::Doorways, Anchors::All}) {
        for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
            params.path.path_mode = mode;
            params.constraints.anchors = anchors;
            const auto plan = planOf(scene, params);
            EXPECT_TRUE(atTheDoor(*plan));
            ASSERT_EQ(plan->anchors.size(), anchors == Anchors::All ? 3U : 1U);
            EXPECT_EQ(plan->anchors[0].kind, "doorways");
            EXPECT_EQ(plan->anchors[0].found, 1);
            EXPECT_EQ(plan->anchors[0].visited, 1);
            EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
        }
    }
    params.constraints.min_pitch_deg = 5.0;
    EXPECT_GE(planOf(scene, params)->trajectory.frames.size(), 1U);
}

TEST(Anchors, OpeningsAreLookedOutOfAndCorridorsAlong) {
    test::SceneBuilder builder;
    // Four walls, one of them with an opening of 1.2 x 1 m.
    builder.object("floor", {kNyuFloor, Role::Structure, {0.5F, 0.5F, 0.5F}})
        .quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    builder.object("ceiling", {kNyuCeiling, Role::Structure, {0.5F, 0.5F, 0.5F}})
        .quad({0, 0, 2.5}, {0, 3, 0}, {4, 0, 0});
    builder.object("walls", kWallLook)
        .quad({0, 0, 0}, {0, 0, 2.5}, {4, 0, 0})
        .quad({0, 3, 0}, {4, 0, 0}, {0, 0, 2.5})
        .quad({0, 0, 0}, {0, 3, 0}, {0, 0, 2.5})
        .quad({4, 0, 0}, {0, 0, 2.5}, {0, 0.9, 0})
        .quad({4, 2.1, 0}, {0, 0, 2.5}, {0, 0.9, 0})
        .quad({4, 0.9, 0}, {0, 0, 0.9}, {0, 1.2, 0})
        .quad({4, 0.9, 1.9}, {0, 0, 0.6}, {0, 1.2, 0});
    builder.object("cube").box({1.0, 0.6, 0.25}, {0.5, 0.5, 0.5});
    PlanParams params;
    params.constraints.anchors = Anchors::Openings;
    const Eigen::Vector3d hole(4.0, 1.5, 1.4);
    const auto looksOut = [&](const Plan& plan) {
        return std::any_of(plan.trajectory.frames.begin(), plan.trajectory.frames.end(),
                           [&](const TrajectoryFrame& frame) {
                               return frame.pose.position.x() < 4.0 &&
                                      angleBetween(Eigen::Vector3d(hole - frame.pose.position),
                                                   frame.pose.forward()) < 0.15;
                           });
    };
    const auto hole_plan = planOf(builder.build(), params);
    EXPECT_TRUE(looksOut(*hole_plan));
    ASSERT_EQ(hole_plan->anchors.size(), 1U);
    EXPECT_EQ(hole_plan->anchors[0].visited, 1);

    // The error says what the scene lacks.
    params.constraints.anchors = Anchors::Corridors;
    const auto without = planOf(builder.build(), params);
    ASSERT_EQ(without->anchors.size(), 1U);
    EXPECT_EQ(without->anchors[0].kind, "corridors");
    EXPECT_EQ(without->anchors[0].found, 0);
    const auto plan = planOf(roomAtACorridor(), params);
    for (const double side : {1.0, -1.0}) {
        EXPECT_TRUE(std::any_of(plan->trajectory.frames.begin(), plan->trajectory.frames.end(),
                                [&](const TrajectoryFrame& frame) {
                                    const Eigen::Vector3d& p = frame.pose.position;
                                    return p.y() < 1.3 && side * (p.x() - 3.5) < -2.5 &&
                                           side * frame.pose.forward().x() > 0.97;
                                }));
    }
}

}  // namespace dollytrack::planning::room_tours_test
