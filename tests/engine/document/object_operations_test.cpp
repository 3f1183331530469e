#include "engine/document/edits_json.h"
#include "engine/document/regroup.h"
#include "engine/scene/labels.h"
#include "tests/engine/document/editing.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace dollytrack::object_operations_test {
namespace {

using nlohmann::json;
using test::Editing;

/// Every triangle of the scene as its corners and the name of its object, sorted.
std::vector<std::array<float, 9>> cornersOf(const Scene& scene, const Object& object) {
    std::vector<std::array<float, 9>> list;
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        std::array<float, 9> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = scene.triangles[object.first_triangle + i][k];
            EXPECT_GE(v, object.first_vertex);
            EXPECT_LT(v, object.first_vertex + object.vertex_count);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                corners[3 * k + axis] = scene.positions[v][static_cast<Eigen::Index>(axis)];
            }
        }
        list.push_back(corners);
    }
    std::sort(list.begin(), list.end());
    return list;
}

void expectWellFormed(const Scene& scene) {
    std::uint32_t vertex = 0;
    std::uint32_t triangle = 0;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        EXPECT_EQ(object.id, static_cast<int>(i) + 1);
        EXPECT_EQ(object.first_vertex, vertex);
        EXPECT_EQ(object.first_triangle, triangle);
        vertex += object.vertex_count;
        triangle += object.triangle_count;
    }
    EXPECT_EQ(vertex, scene.positions.size());
    EXPECT_EQ(vertex, scene.normals.size());
    EXPECT_EQ(vertex, scene.uvs.size());
    EXPECT_EQ(triangle, scene.triangles.size());
    EXPECT_EQ(triangle, scene.triangle_material.size());
}

}  // namespace

TEST(Operation, SplitGivesTwoObjectsWithExactBoxes) {
    Editing editing;
    const auto names = editing.apply({{{"op", "split"}, {"object", "pair"}}});
    ASSERT_TRUE(names) << describe(names.error());
    EXPECT_EQ(names->front(), "Split pair into 2 pieces, the smallest 0.5 m");
    const Scene scene = editing.scene();
    expectWellFormed(scene);
    ASSERT_EQ(scene.objects.size(), 10U);
    EXPECT_EQ(scene.object(8).name, "pair_1");
    EXPECT_EQ(scene.object(9).name, "pair_2");
    EXPECT_EQ(scene.object(10).name, "mug");
    EXPECT_LT((scene.object(8).box.center - Eigen::Vector3d(1, 1, 0.25)).norm(), 1e-6);
    EXPECT_LT((scene.object(8).box.half_size - Eigen::Vector3d(0.25, 0.25, 0.25)).norm(), 1e-6);
    EXPECT_LT((scene.object(9).box.center - Eigen::Vector3d(3, 2, 0.4)).norm(), 1e-6);
    EXPECT_LT((scene.object(9).box.half_size - Eigen::Vector3d(0.2, 0.3, 0.4)).norm(), 1e-6);
    EXPECT_LT((scene.object(9).centroid - Eigen::Vector3d(3, 2, 0.4)).norm(), 1e-6);
    // Together they have the triangles of the split object; neighbours are unchanged.
    auto both = cornersOf(scene, scene.object(8));
    const auto second = cornersOf(scene, scene.object(9));
    both.insert(both.end(), second.begin(), second.end());
    std::sort(both.begin(), both.end());
    EXPECT_EQ(both, cornersOf(editing.imported, editing.imported.object(8)));
    EXPECT_EQ(cornersOf(scene, scene.object(10)),
              cornersOf(editing.imported, editing.imported.object(9)));
}

TEST(Operation, MergeGivesOneObjectAtThePlaceOfTheFirst) {
    Editing editing;
    const auto names = editing.apply({{{"op", "merge"},
                                       {"objects", {"mug", "lamp"}},
                                       {"name", "still life"},
                                       {"class", "lamp"}}});
    ASSERT_TRUE(names) << describe(names.error());
    const Scene scene = editing.scene();
    expectWellFormed(scene);
    ASSERT_EQ(scene.objects.size(), 8U);
    const Object& merged = scene.object(7);
    EXPECT_EQ(merged.name, "still life");
    EXPECT_EQ(nyu40Name(merged.nyu40), "lamp");
    EXPECT_EQ(merged.role, Role::Target);
    EXPECT_EQ(scene.object(8).name, "pair");
    // The box around both objects' vertices.
    for (const int id : {7, 9}) {
        for (const Eigen::Vector3d& corner : editing.imported.object(id).box.corners()) {
            EXPECT_TRUE(merged.box.contains(corner, 1e-5));
        }
    }
    auto both = cornersOf(editing.imported, editing.imported.object(7));
    const auto second = cornersOf(editing.imported, editing.imported.object(9));
    both.insert(both.end(), second.begin(), second.end());
    std::sort(both.begin(), both.end());
    EXPECT_EQ(cornersOf(scene, merged), both);
}

TEST(Operation, FurnitureInASplitWallBecomesATarget) {
    test::SceneBuilder builder;
    builder.object("shell", {kNyuWall, Role::Structure})
        .box({2, 0, 1.3}, {4, 0.2, 2.6})
        .box({2, 1, 0.15}, {1.5, 1.0, 0.3})
        .box({1, 0.12, 0.05}, {2, 0.02, 0.1});
    Scene scene = builder.build();
    scene.objects[0].structure = true;
    const auto pieces = findPieces(scene, scene.object(1));
    ASSERT_EQ(pieces.size(), 3U);
    splitObject(scene, 1, pieces, {"wall", "bench", "skirting"});
    for (const Object& object : scene.objects) {
        const bool bench = object.name == "bench";
        EXPECT_EQ(object.structure, !bench) << object.name;
        EXPECT_EQ(object.role, bench ? Role::Target : Role::Structure) << object.name;
        EXPECT_EQ(object.nyu40, bench ? kNyuUnknown : kNyuWall) << object.name;
    }
}

TEST(Operation, SplitAndMergeBackIsTheSameSurface) {
    Editing editing;
    ASSERT_TRUE(
        editing.apply({{{"op", "split"}, {"object", "pair"}},
                       {{"op", "merge"}, {"objects", {"pair_1", "pair_2"}}, {"name", "pair"}}}));
    const Scene scene = editing.scene();
    expectWellFormed(scene);
    EXPECT_EQ(cornersOf(scene, scene.object(8)),
              cornersOf(editing.imported, editing.imported.object(8)));
    EXPECT_EQ(scene.object(8).box, [&] {
        Scene other = editing.imported;
        return applySceneEdits(other, editing.state.edits.scene)->object(8).box;
    }());
}

namespace {

/// A sofa of two cushions with six buttons on each, two lamps of two pieces each, and a mug.
Scene sofaScene() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 4, 2.6});  // 1..6
    auto& sofa = builder.object("sofa");   // 7
    for (const double x : {1.0, 2.2}) {
        sofa.box({x, 2, 0.4}, {1, 0.8, 0.4});
        for (int i = 0; i < 6; ++i) sofa.box({x - 0.4 + 0.15 * i, 2, 0.61}, {0.02, 0.02, 0.02});
    }
    test::SceneBuilder::Look lamp;
    lamp.nyu40 = kNyuLamp;
    builder.object("Lamp_1", lamp)
        .box({5, 1, 0.05}, {0.3, 0.3, 0.1})
        .box({5, 1, 1}, {0.2, 0.2, 0.2});
    builder.object("Lamp_2", lamp)
        .box({5, 3, 0.05}, {0.3, 0.3, 0.1})
        .box({5, 3, 1}, {0.2, 0.2, 0.2});
    builder.object("mug").box({3, 1, 0.05}, {0.1, 0.1, 0.1});  // 10
    return builder.build();
}

}  // namespace

TEST(Operation, ASplitKeepsSmallPiecesWithTheNearestLargeOne) {
    Editing editing;
    editing.imported = sofaScene();
    EXPECT_EQ(editing.apply({{{"op", "split"}, {"object", "sofa"}}})->front(),
              "Split sofa into 14 pieces, the smallest 0.02 m");
    editing.state = {};
    const auto names = editing.apply({{{"op", "split"}, {"object", "sofa"}, {"min_size_m", 0.1}}});
    ASSERT_TRUE(names) << describe(names.error());
    EXPECT_EQ(names->front(),
              "Split sofa into 2 pieces, the smallest 1 m, 12 smaller ones with the nearest");
    const Scene scene = editing.scene();
    expectWellFormed(scene);
    ASSERT_EQ(scene.objects.size(), 11U);
    EXPECT_EQ(scene.object(7).triangle_count, 7U * 12U);  // a cushion and its six buttons
    EXPECT_EQ(scene.object(8).triangle_count, 7U * 12U);
    EXPECT_LT(scene.object(7).box.center.x(), 1.6);
    EXPECT_GT(scene.object(8).box.center.x(), 1.6);
    // The project file gives the same definitions.
    const Result<Edits> read = editsFromJson(editsJson(editing.state.edits));
    ASSERT_TRUE(read) << describe(read.error());
    EXPECT_EQ(*read, editing.state.edits);

    editing.state = {};
    ASSERT_TRUE(editing.apply({{{"op", "split"}, {"object", "sofa"}, {"max_pieces", 3}}}));
    EXPECT_EQ(editing.scene().objects.size(), 12U);
    const auto none = editing.apply({{{"op", "split"}, {"object", "mug"}, {"min_size_m", 2}}});
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("lower min_size_m"), std::string::npos);
    EXPECT_FALSE(editing.apply({{{"op", "split"}, {"object", 7}, {"max_pieces", 1}}}));
}

TEST(Operation, PatternsAndClassesNameSeveralObjects) {
    Editing editing;
    editing.imported = sofaScene();
    const auto nameOf = [&](const json& operation) {
        const auto names = editing.apply(json::array({operation}));
        return names ? names->front() : describe(names.error());
    };
    EXPECT_EQ(nameOf({{"op", "exclude"}, {"class", "lamp"}}), "Exclude Lamp_1 and Lamp_2");
    EXPECT_EQ(editing.scene().object(8).role, Role::Excluded);
    EXPECT_EQ(editing.scene().object(9).role, Role::Excluded);
    EXPECT_EQ(editing.scene().object(10).role, Role::Target);
    EXPECT_EQ(nameOf({{"op", "include"}, {"object", "lamp*"}}), "Include Lamp_1 and Lamp_2");
    EXPECT_EQ(editing.state, ProjectState{});
    EXPECT_EQ(nameOf({{"op", "set_class"}, {"object", {"lamp", "m?g"}}, {"class", "chair"}}),
              "Make Lamp_1, Lamp_2 and mug a chair");
    EXPECT_EQ(nyu40Name(editing.scene().object(10).nyu40), "chair");
    EXPECT_EQ(nameOf({{"op", "reset_object"}, {"class", "chair"}}), "Reset Lamp_1, Lamp_2 and mug");
    EXPECT_EQ(editing.state, ProjectState{});

    // Each object's definition refers to the numbers after the previous one.
    EXPECT_EQ(nameOf({{"op", "split"}, {"object", "Lamp_*"}}),
              "Split Lamp_1 and Lamp_2 into 4 pieces, the smallest 0.2 m");
    const Scene split = editing.scene();
    expectWellFormed(split);
    ASSERT_EQ(split.objects.size(), 12U);
    EXPECT_TRUE(split.report.warnings.empty());
    EXPECT_EQ(split.object(8).name, "Lamp_1_1");
    EXPECT_EQ(split.object(11).name, "Lamp_2_2");
    EXPECT_EQ(split.object(12).name, "mug");
    EXPECT_EQ(nameOf({{"op", "merge"}, {"objects", {"Lamp_1_*"}}, {"name", "Lamp_1"}}),
              "Make Lamp_1 of Lamp_1_1 and Lamp_1_2");

    EXPECT_NE(nameOf({{"op", "exclude"}, {"object", "Chair_*"}}).find("no object 'Chair_*'"),
              std::string::npos);
    EXPECT_NE(nameOf({{"op", "exclude"}, {"class", "toilet"}}).find("no object of the class"),
              std::string::npos);
    EXPECT_NE(nameOf({{"op", "exclude"}, {"class", "lamp"}, {"object", "mug"}}).find("not both"),
              std::string::npos);
}

TEST(Operation, ObjectsWithoutAClassAreNamedByThat) {
    for (const json& operation :
         {json{{"op", "exclude"}, {"class", "unknown"}},
          json{{"op", "set_class"}, {"object", "unknown"}, {"class", "chair"}}}) {
        Editing editing;
        editing.imported = sofaScene();
        editing.imported.objects.back().nyu40 = 0;
        ASSERT_TRUE(editing.apply(json::array({operation}))) << operation;
        const ObjectChange& change = editing.state.edits.scene.changes.at(0);
        EXPECT_EQ(change.object.name, editing.imported.objects.back().name);
        EXPECT_EQ(editing.state.edits.scene.changes.size(), 1U);
    }
}

TEST(Operation, AGroupIsMadeOfWhatTouches) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 4, 2.6});  // 1..6
    builder.object("seats").box({1, 1, 0.45}, {0.4, 0.4, 0.1}).box({3, 1, 0.45}, {0.4, 0.4, 0.1});
    for (const double x : {0.85, 1.15, 2.85, 3.15, 5.0}) {
        const std::string name = "leg " + std::to_string(static_cast<int>(100 * x));
        builder.object(name).box({x, 1, 0.2}, {0.05, 0.05, 0.398});
    }
    builder.object("lamp").box({1, 1.25, 0.45}, {0.09, 0.09, 0.1});  // 5 mm from a seat
    Editing editing;
    editing.imported = builder.build();
    ASSERT_TRUE(editing.apply({
        {{"op", "exclude"}, {"object", "leg 500"}},
        {{"op", "split"}, {"object", "seats"}},
        {{"op", "group"}, {"object", {"seats*", "leg*"}}, {"name", "chair"}},
    }));
    const Scene scene = editing.scene();
    expectWellFormed(scene);
    std::vector<std::string> names;
    for (std::size_t i = 6; i < scene.objects.size(); ++i) names.push_back(scene.objects[i].name);
    EXPECT_EQ(names, (std::vector<std::string>{"chair_1", "chair_2", "leg 500", "lamp"}));
    EXPECT_EQ(scene.object(7).triangle_count, 36U);  // a seat and two legs of 12
    EXPECT_NEAR(scene.object(8).box.center.x(), 3.0, 0.01);
    EXPECT_EQ(scene.object(9).role, Role::Excluded);
    EXPECT_EQ(scene.object(10).role, Role::Target);

    // With a larger gap, named after the largest part, saved and loaded like any definition.
    ASSERT_TRUE(
        editing.apply({{{"op", "group"}, {"object", {"chair_*", "lamp"}}, {"gap_m", 0.01}}}));
    EXPECT_EQ(editing.scene().objects.size(), 9U);
    EXPECT_EQ(editing.scene().object(7).name, "chair_1");
    const auto none = editing.apply({{{"op", "group"}, {"object", "chair_*"}}});
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("raise gap_m"), std::string::npos);
}

TEST(Operation, NumbersFollowWhatDefinitionsDo) {
    Editing editing;
    ASSERT_TRUE(editing.apply({
        {{"op", "exclude"}, {"object", "mug"}},
        {{"op", "set_class"}, {"object", "pair"}, {"class", "table"}},
        {{"op", "pin"}, {"objects", {"mug"}}, {"position", {2, 1, 1}}, {"target", {2, 2.5, 0.05}}},
        {{"op", "remove_point"}, {"objects", {"lamp", "mug"}}},
    }));
    ASSERT_TRUE(editing.apply({{{"op", "split"}, {"object", "pair"}}}));
    const Edits& edits = editing.state.edits;
    ASSERT_EQ(edits.scene.changes.size(), 3U);  // both pieces are tables
    EXPECT_EQ(edits.scene.changes[0].object, (ObjectRef{8, "pair_1"}));
    EXPECT_EQ(edits.scene.changes[1].object, (ObjectRef{9, "pair_2"}));
    EXPECT_EQ(edits.scene.changes[2].object, (ObjectRef{10, "mug"}));
    EXPECT_EQ(edits.plan.pinned[0].objects, (std::vector<ObjectRef>{{10, "mug"}}));
    EXPECT_EQ(edits.plan.removed[0].objects, (std::vector<ObjectRef>{{7, "lamp"}, {10, "mug"}}));

    ASSERT_TRUE(editing.apply(
        {{{"op", "merge"}, {"objects", {"lamp", "pair_1"}}, {"name", "reading corner"}}}));
    const Edits& merged = editing.state.edits;
    EXPECT_EQ(merged.plan.pinned[0].objects, (std::vector<ObjectRef>{{9, "mug"}}));
    EXPECT_EQ(merged.plan.removed[0].objects,
              (std::vector<ObjectRef>{{7, "reading corner"}, {9, "mug"}}));
    ASSERT_EQ(merged.scene.changes.size(), 2U);
    EXPECT_EQ(merged.scene.changes[0].object, (ObjectRef{8, "pair_2"}));
    const Scene scene = editing.scene();
    EXPECT_EQ(editing.find(scene, "mug")->role, Role::Excluded);
    EXPECT_EQ(nyu40Name(editing.find(scene, "pair_2")->nyu40), "table");
    EXPECT_TRUE(scene.report.warnings.empty());
}

// This is one undo step, and the history names all changed objects.
TEST(Operation, ExcludesAndIncludesSeveralObjectsAtOnce) {
    Editing editing;
    const json all = {"lamp", "pair", "mug", 1};  // the last one is structure
    auto names = editing.apply({{{"op", "exclude"}, {"object", all}}});
    ASSERT_TRUE(names) << describe(names.error());
    EXPECT_EQ(names->front(), "Exclude lamp, pair and mug");
    Scene scene = editing.scene();
    EXPECT_EQ(std::ranges::count(scene.objects, Role::Excluded, &Object::role), 3);
    EXPECT_NE(scene.object(1).role, Role::Excluded);
    names = editing.apply({{{"op", "include"}, {"object", {"lamp", "mug"}}}});
    ASSERT_TRUE(names) << describe(names.error());
    EXPECT_EQ(names->front(), "Include lamp and mug");
    scene = editing.scene();
    EXPECT_EQ(editing.find(scene, "lamp")->role, Role::Target);
    EXPECT_EQ(editing.find(scene, "pair")->role, Role::Excluded);
    EXPECT_FALSE(editing.apply({{{"op", "exclude"}, {"object", {1, 2}}}}))
        << "nothing but the building";
}

}  // namespace dollytrack::object_operations_test
