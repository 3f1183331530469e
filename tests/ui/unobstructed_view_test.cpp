#include "ui/viewport/unobstructed_view.h"

#include "engine/scene/room_bounds.h"
#include "engine/scene/storeys.h"
#include "render/draw/storey_cutaway.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

namespace dollytrack::ui::unobstructed_view_test {
namespace {

using test::SceneBuilder;

const IsCutAway kNothing = [](int, const Eigen::Vector3d&) { return false; };

Eigen::AlignedBox3d boxOf(const Scene& scene, const std::string& name) {
    for (const Object& object : scene.objects) {
        if (object.name == name) return worldBounds(object.box);
    }
    return {};
}

/// A cube behind a screen that hides its half with y > 0 from an eye on the x axis.
Scene halfHidden() {
    return SceneBuilder()
        .object("cube")
        .box({0, 0, 0}, {1, 1, 1})
        .object("screen")
        .box({1, 1.01, 0}, {0.1, 2, 4})
        .build();
}

TEST(ClearLook, CountsTheShareOfABoxThatIsSeen) {
    const Scene scene = halfHidden();
    const RayCaster rays(scene);
    // A row of points has y > 0, one y = 0, one y < 0; the screen begins at y = 0.01.
    EXPECT_NEAR(shareSeen(rays, {100, 0, 0}, boxOf(scene, "cube"), kNothing), 2.0 / 3.0, 1e-9);
    EXPECT_EQ(shareSeen(rays, {-100, 0, 0}, boxOf(scene, "cube"), kNothing), 1.0);
    EXPECT_EQ(shareSeen(rays, {0, 0, 0}, boxOf(scene, "cube"), kNothing), 1.0) << "from inside";
    const int screen = scene.objects.back().id;
    const IsCutAway no_screen = [&](int id, const Eigen::Vector3d&) { return id == screen; };
    EXPECT_EQ(shareSeen(rays, {100, 0, 0}, boxOf(scene, "cube"), no_screen), 1.0);
}

TEST(ClearLook, StaysWhereAllIsSeenAndTurnsOutFromBehindAWall) {
    const Scene scene = SceneBuilder()
                            .object("cube")
                            .box({0, 0, 0}, {1, 1, 1})
                            .object("wall")
                            .box({0.8, 0, 0}, {0.1, 8, 8})
                            .build();
    const RayCaster rays(scene);
    const Eigen::AlignedBox3d cube = boxOf(scene, "cube");
    const auto seen = [&](const ViewerCamera& camera) {
        return shareSeen(rays, camera.pose().position, cube, kNothing);
    };
    ViewerCamera camera;
    camera.frame(cube, 1.0);
    camera.elevation = 0.3;
    camera.azimuth = 3.1;  // from -x, where nothing is in the way
    const ViewerCamera kept = unobstructedView(camera, seen);
    EXPECT_EQ(kept.azimuth, camera.azimuth);
    EXPECT_EQ(kept.elevation, camera.elevation);

    camera.azimuth = 0.1;  // behind the wall
    ASSERT_LT(seen(camera), 0.05);
    const ViewerCamera turned = unobstructedView(camera, seen);
    EXPECT_LT(turned.pose().position.x(), 0.75) << "on the cube's side of the wall";
    EXPECT_GE(seen(turned), 0.8);
    EXPECT_EQ(turned.distance, camera.distance);
    EXPECT_EQ(turned.pivot, camera.pivot);
}

TEST(ClearLook, PicturesLeaveAwayWhatIsHiddenAndStructureAboveTheCut) {
    const Scene scene = SceneBuilder()
                            .room({0, 0, 0}, {4, 3, 2.5})
                            .object("cube")
                            .box({2, 1.5, 2}, {0.4, 0.4, 0.4})
                            .build();
    const int wall = scene.objects.front().id;
    const int cube = scene.objects.back().id;
    render::View view;
    EXPECT_FALSE(render::isCutAway(view, scene, wall, {0, 0, 2}));
    view.structure_cut = render::StructureCut{{0, 0, 1, 1.0}, 0.1};
    EXPECT_TRUE(render::isCutAway(view, scene, wall, {0, 0, 2}));
    EXPECT_FALSE(render::isCutAway(view, scene, wall, {0, 0, 0.5}));
    EXPECT_FALSE(render::isCutAway(view, scene, cube, {2, 1.5, 2})) << "things are never cut";
    view.structure_cut = render::StructureCut{{0, 0, 1, 9.0}, 0.1, 2.4};
    EXPECT_TRUE(render::isCutAway(view, scene, wall, {2, 1.5, 2.45})) << "above the ceiling";
    EXPECT_FALSE(render::isCutAway(view, scene, wall, {0, 0, 2.3}));
    EXPECT_FALSE(render::isCutAway(view, scene, cube, {2, 1.5, 2.45}));
    view.clip_box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 1.9));
    EXPECT_TRUE(render::isCutAway(view, scene, cube, {2, 1.5, 2})) << "a clipping box cuts objects";
    EXPECT_FALSE(render::isCutAway(view, scene, cube, {2, 1.5, 1.85}));
    view.clip_box.reset();
    view.hidden.assign(static_cast<std::size_t>(cube) + 1, false);
    view.hidden[cube] = true;
    EXPECT_TRUE(render::isCutAway(view, scene, cube, {2, 1.5, 2}));
}

// The view looks into the upper storey; the inside of a cupboard does not tell the height of the
// ceiling.
TEST(ClearLook, TheCeilingIsWhereTheRoomsOfTheTopmostStoreyEnd) {
    const Scene scene = SceneBuilder().room({0, 0, 0}, {4, 3, 5.5}).build();
    const auto room = [](double floor, double ceiling, double side) {
        return Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, floor),
                                   Eigen::Vector3d(side, side, ceiling));
    };
    const std::vector<Eigen::AlignedBox3d> rooms = {room(0.1, 2.5, 4.0), room(2.9, 5.3, 4.0),
                                                    room(3.1, 5.1, 3.0), room(3.0, 4.0, 0.6)};
    EXPECT_DOUBLE_EQ(render::ceilingOf(scene, rooms), 5.1);
    EXPECT_GT(render::ceilingOf(scene, {}), scene.room_bounds.max().z()) << "no room, no ceiling";
}

// A hollow below the floor, as in scans, must not cause the floor to be cut away.
TEST(ClearLook, AFloorIsNeverCut) {
    const Scene scene = SceneBuilder()
                            .object("shell", {kNyuWall, Role::Structure, {0.6F, 0.6F, 0.6F}})
                            .quad({0, 0, 0}, {6, 0, 0}, {0, 5, 0})
                            .quad({0, 0, -1.2}, {2, 0, 0}, {0, 0, 1.2})
                            .build();
    const std::vector<Eigen::AlignedBox3d> rooms = {
        {Eigen::Vector3d(0.1, 0.1, 0.1), Eigen::Vector3d(5.9, 4.9, 2.5)},
        {Eigen::Vector3d(0.1, 0.1, -1.1), Eigen::Vector3d(1.0, 1.0, -0.1)}};
    for (const bool planned : {true, false}) {
        const auto known = planned ? std::span<const Eigen::AlignedBox3d>(rooms)
                                   : std::span<const Eigen::AlignedBox3d>();
        const render::StoreyView storey = render::storeysOf(scene, known).back();
        render::View view;
        view.structure_cut =
            render::cutTowards(scene.room_bounds, storey.floor_z, storey.ceiling_z, {0.9, 0, 0});
        for (const double x : {0.1, 3.0, 5.9}) {
            EXPECT_FALSE(render::isCutAway(view, scene, 1, {x, 2.5, 0.0})) << planned << x;
        }
    }
}

Scene houseOfTwoStoreys() {
    const SceneBuilder::Look floor{kNyuFloor, Role::Structure, {0.6F, 0.6F, 0.6F}};
    const SceneBuilder::Look ceiling{kNyuCeiling, Role::Structure, {0.5F, 0.3F, 0.2F}};
    return SceneBuilder()
        .room({0, 0, 0}, {6, 4, 5.4}, false)
        .object("slab", floor)
        .box({3.5, 2, 2.7}, {5, 4, 0.2})
        .object("attic floor", ceiling)
        .quad({0, 0, 5.4}, {6, 0, 0}, {0, 4, 0})
        .object("roof", ceiling)
        .quad({0, 0, 5.4}, {6, 0, 0}, {0, 2, 1.5})
        .object("chest below")
        .box({3, 2, 0.3}, {1, 0.6, 0.6})
        .object("bed above")
        .box({4, 2, 3.05}, {2, 1.5, 0.5})
        .object("weathercock")
        .box({3, 2, 7.0}, {0.4, 0.05, 0.4})
        .build();
}

TEST(ClearLook, WhatLiesOverAStoreyIsLeftAwayAndItsFloorIsNot) {
    const Scene scene = houseOfTwoStoreys();
    // The stairs make one room of both storeys.
    const std::vector<Eigen::AlignedBox3d> rooms = {
        {Eigen::Vector3d(0.1, 0.1, 0.1), Eigen::Vector3d(5.9, 3.9, 5.3)}};
    const auto id = [&](const std::string& name) {
        return std::ranges::find(scene.objects, name, &Object::name)->id;
    };
    for (const bool planned : {true, false}) {
        const auto known = planned ? std::span<const Eigen::AlignedBox3d>(rooms)
                                   : std::span<const Eigen::AlignedBox3d>();
        const std::vector<render::StoreyView> storeys = render::storeysOf(scene, known);
        ASSERT_EQ(storeys.size(), 2U);
        EXPECT_NEAR(storeys[1].floor_z, 2.8, 0.03);
        EXPECT_LT(storeys[0].ceiling_z, 2.6);
        for (std::size_t s = 0; s < 2; ++s) {
            render::View view;
            view.hidden = render::hiddenFor(scene, storeys[s]);
            view.structure_cut = render::cutTowards(
                render::withinStorey(render::buildingOf(scene, known), storeys[s]),
                storeys[s].floor_z, storeys[s].ceiling_z, {0.9, 0, 0});
            const auto gone = [&](const std::string& name, const Eigen::Vector3d& at) {
                return render::isCutAway(view, scene, id(name), at);
            };
            EXPECT_TRUE(gone("roof", {3, 1, 6.1}));
            EXPECT_TRUE(!planned || gone("weathercock", {3, 2, 7}));
            EXPECT_FALSE(gone("chest below", {3, 2, 0.6}));
            EXPECT_EQ(gone("bed above", {4, 2, 3.3}), s == 0);
            EXPECT_EQ(gone("slab", {5.9, 2, 2.8}), s == 0) << "the floor on the viewer's side";
            EXPECT_FALSE(gone("floor", {5.9, 2, 0.0}));
        }
    }
}

}  // namespace
}  // namespace dollytrack::ui::unobstructed_view_test
