#include "engine/document/edits_json.h"
#include "engine/scene/labels.h"
#include "engine/scene/move_object.h"
#include "tests/engine/document/editing.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <numbers>

namespace dollytrack::operation_test {
namespace {

using nlohmann::json;
using test::Editing;

}  // namespace

TEST(Operation, ChangesSayWhatTheySayAndCanBeTakenBack) {
    Editing editing;
    ASSERT_TRUE(editing.apply({{{"op", "set_front"}, {"object", 7}, {"front", 90}},
                               {{"op", "set_size"}, {"object", 7}, {"size", "large"}},
                               {{"op", "exclude"}, {"object", "lamp"}},
                               {{"op", "include"}, {"object", "floor"}}}));
    const Scene scene = editing.scene();
    EXPECT_LT((scene.object(7).front - Eigen::Vector3d::UnitY()).norm(), 1e-12);
    EXPECT_EQ(scene.object(7).front_source, FrontSource::Annotation);
    EXPECT_TRUE(scene.object(7).large);
    EXPECT_EQ(scene.object(7).role, Role::Excluded);
    EXPECT_EQ(scene.object(1).role, Role::Target);
    EXPECT_TRUE(scene.object(1).structure);

    ASSERT_TRUE(editing.apply(
        {{{"op", "reset_object"}, {"object", "lamp"}}, {{"op", "exclude"}, {"object", "floor"}}}));
    EXPECT_EQ(editing.state, ProjectState{});
}

TEST(Operation, AListIsAppliedWholeOrNotAtAll) {
    Editing editing;
    const ProjectState before = editing.state;
    const auto result = editing.apply(
        {{{"op", "exclude"}, {"object", "mug"}}, {{"op", "exclude"}, {"object", "lmap"}}});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Usage);
    EXPECT_EQ(result.error().where, "operation 2, object");
    EXPECT_NE(result.error().message.find("did you mean 'lamp'"), std::string::npos);
    EXPECT_EQ(editing.state, before);
}

TEST(Operation, BoxesAndRegionsHaveALargestNumber) {
    for (const std::string op : {"add_no_go", "add_region", "add_point"}) {
        Editing editing;
        json add = {{"op", op}, {"center", {1, 1, 1}}, {"size", {1, 1, 1}}};
        if (op == "add_point") add = {{"op", op}, {"position", {1, 1, 1}}, {"yaw_deg", 0}};
        const json all(kMostPlanEntries, add);
        ASSERT_TRUE(editing.apply(all)) << op;
        const auto result = editing.apply(json::array({all[0]}));
        ASSERT_FALSE(result) << op;
        EXPECT_NE(result.error().message.find("There are 1000"), std::string::npos);
        json file = editsJson(editing.state.edits);
        EXPECT_TRUE(editsFromJson(file)) << op;
        json& list = file[op == "add_no_go" ? "no_go" : op == "add_region" ? "regions" : "pinned"];
        list.push_back(list.back());
        list.back()["name"] = "one more";
        ASSERT_FALSE(editsFromJson(file)) << op;
        EXPECT_NE(editsFromJson(file).error().message.find("1001 entries"), std::string::npos);
    }
}

TEST(Operation, AListStopsWhenCancelled) {
    Editing editing;
    const ProjectState before = editing.state;
    const JobContext cancelled(std::make_shared<std::atomic<bool>>(true), {});
    const auto result =
        applyOperations(editing.state, editing.imported, test::setTestParameter,
                        json::array({{{"op", "exclude"}, {"object", "mug"}}}), {}, cancelled);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(editing.state, before);
}

TEST(Operation, SaysWhatIsWrong) {
    const std::vector<std::pair<json, std::string>> wrong = {
        {{{"op", "exlude"}, {"object", "mug"}}, "did you mean 'exclude'"},
        {{{"op", "exclude"}, {"objekt", "mug"}}, "did you mean 'object'"},
        {{{"op", "exclude"}}, "needs the field 'object'"},
        {{{"op", "exclude"}, {"object", 99}}, "from 1 to 9"},
        {{{"op", "exclude"}, {"object", "wall_east"}}, "part of the building"},
        {{{"op", "set_class"}, {"object", "mug"}, {"class", "chiar"}}, "did you mean 'chair'"},
        {{{"op", "set_class"}, {"object", "mug"}, {"class", 41}}, "from 1 to 40"},
        {{{"op", "set_front"}, {"object", "mug"}, {"front", {0, 0}}}, "must not be [0, 0]"},
        {{{"op", "set_size"}, {"object", "mug"}, {"size", "huge"}}, "large, small or auto"},
        {{{"op", "move_object"}, {"object", "mug"}}, "Give an offset or turn_deg"},
        {{{"op", "move_object"}, {"object", "mug"}, {"offset", {0, 2e4, 0}}}, "at most 10000 m"},
        {{{"op", "move_object"}, {"object", "mug"}, {"turn_deg", 400}}, "-360"},
        {{{"op", "move_objects"}, {"moves", json::array()}}, "must be a list"},
        {{{"op", "move_objects"}, {"moves", {{{"object", "mug"}}}}}, "Give an offset or turn_deg"},
        {{{"op", "move_objects"}, {"moves", {{{"object", "mug"}, {"by", {1, 0, 0}}}}}}, "not 'by'"},
        {{{"op", "object_track"}, {"object", "mug"}, {"keys", 3}}, "must be a list"},
        {{{"op", "object_track"}, {"object", "mug"}, {"keys", {{{"time_s", 1}}, {{"time_s", 1}}}}},
         "increasing time_s"},
        {{{"op", "object_track"}, {"object", "mug"}, {"keys", {{{"time_s", 1}, {"turn", 9}}}}},
         "not 'turn'"},
        {{{"op", "at_time"}, {"time_s", 1}}, "No object has a track"},
        {{{"op", "merge"}, {"objects", {"mug"}}, {"name", "x"}}, "two objects"},
        {{{"op", "merge"}, {"objects", {"mug", "mug"}}, {"name", "x"}}, "twice"},
        {{{"op", "merge"}, {"objects", {"mug", "pair"}}, {"name", "lamp"}}, "called 'lamp'"},
        {{{"op", "split"}, {"object", "mug"}}, "one connected piece"},
        {{{"op", "pin"}, {"objects", {"mug"}}, {"position", {1, 1, 1}}},
         "the direction of the camera"},
        {{{"op", "pin"}, {"objects", {"mug"}}, {"position", {1, 1}}, {"target", {0, 0, 0}}},
         "three numbers"},
        {{{"op", "pin"}, {"objects", {"mug"}}, {"position", {1, 1, 1}}, {"target", {1, 1, 1}}},
         "must differ from the camera's position"},
        {{{"op", "move_point"}, {"point", "view"}, {"position", {1, 1, 1}}}, "no pinned point"},
        {{{"op", "add_no_go"}, {"center", {1, 1, 1}}, {"size", {1, 0, 1}}}, "above 0"},
        {{{"op", "remove_no_go"}, {"name", "x"}}, "no no-go box"},
        {{{"op", "rename_no_go"}, {"name", "x"}, {"to", "y"}}, "no no-go box"},
        {{{"op", "restore_point"}, {"objects", {"mug"}}}, "was not removed"},
        {{{"op", "set"}, {"name", "fil"}, {"value", 1}}, "no parameter 'fil'"},
        {{{"op", "height_band"}, {"min_m", 2}, {"max_m", 1}}, "above the lower limit of 2 m"},
        {json("exclude"), "An operation is an object"},
    };
    for (const auto& [operation, words] : wrong) {
        Editing editing;
        const auto result = editing.apply(json::array({operation}));
        ASSERT_FALSE(result) << operation.dump();
        EXPECT_NE(result.error().message.find(words), std::string::npos)
            << operation.dump() << ": " << describe(result.error());
        EXPECT_EQ(editing.state, ProjectState{});
    }
}

TEST(Operation, SameNamesNeedTheNumber) {
    Editing editing;
    editing.imported.objects[6].name = "mug";
    const auto result = editing.apply({{{"op", "exclude"}, {"object", "mug"}}});
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("7, 9"), std::string::npos) << result.error().message;
    EXPECT_TRUE(editing.apply({{{"op", "exclude"}, {"object", 9}}}));
}

// The gizmo and number fields pass the whole box or view; only differences are changes.

// A quarter turn about the box's centre maps (x, y) to (-y, x); the offset is applied afterwards.
TEST(Operation, MovesAnObjectWithAllThatIsMeasuredOfIt) {
    Editing editing;
    const Object before = editing.imported.object(7);
    ASSERT_TRUE(editing.apply({{{"op", "set_front"}, {"object", "lamp"}, {"front", 30}},
                               {{"op", "move_object"},
                                {"object", "lamp"},
                                {"offset", {1.0, 0.5, 0.25}},
                                {"turn_deg", 90}}}));
    const Scene scene = editing.scene();
    const Object& lamp = scene.object(7);
    const auto put = [&](const Eigen::Vector3d& p) {
        const Eigen::Vector3d from = p - before.box.center;
        return Eigen::Vector3d(Eigen::Vector3d(-from.y(), from.x(), from.z()) + before.box.center +
                               Eigen::Vector3d(1.0, 0.5, 0.25));
    };
    for (std::uint32_t v = 0; v < scene.positions.size(); ++v) {
        const bool own = v >= lamp.first_vertex && v < lamp.first_vertex + lamp.vertex_count;
        const Eigen::Vector3d was = editing.imported.positions[v].cast<double>();
        const Eigen::Vector3d normal = editing.imported.normals[v].cast<double>();
        const Eigen::Vector3d is = scene.positions[v].cast<double>();
        if (!own) {
            EXPECT_EQ(scene.positions[v], editing.imported.positions[v]);
            EXPECT_EQ(scene.normals[v], editing.imported.normals[v]);
            continue;
        }
        EXPECT_LT((is - put(was)).norm(), 1e-6);
        EXPECT_LT(
            (scene.normals[v].cast<double>() - Eigen::Vector3d(-normal.y(), normal.x(), normal.z()))
                .norm(),
            1e-6);
        EXPECT_TRUE(lamp.box.contains(is, 1e-5));
    }
    EXPECT_LT((lamp.centroid - put(before.centroid)).norm(), 1e-12);
    EXPECT_NEAR(lamp.box.volume(), before.box.volume(), 1e-12);
    // The front set at 30 degrees turned with the lamp; one set now is not turned.
    EXPECT_NEAR(std::atan2(lamp.front.y(), lamp.front.x()), 120.0 * std::numbers::pi / 180, 1e-9);
    ASSERT_TRUE(editing.apply({{{"op", "set_front"}, {"object", "lamp"}, {"front", 10}}}));
    const Eigen::Vector3d front = editing.scene().object(7).front;
    EXPECT_NEAR(std::atan2(front.y(), front.x()), 10.0 * std::numbers::pi / 180, 1e-9);
    EXPECT_EQ(movedObjects(editing.imported, scene), std::vector<int>{7});
    EXPECT_FALSE(sameGeometry({}, editing.state.edits.scene));
}

TEST(Operation, MovingSeveralObjectsIsTheSameAsMovingEach) {
    const json lamp = {{"object", "lamp"}, {"offset", {1.0, 0.5, 0.25}}, {"turn_deg", 90}};
    const json mug = {{"object", "mug"}, {"turn_deg", -30}};
    Editing together;
    const auto names =
        together.apply({{{"op", "move_objects"}, {"moves", json::array({lamp, mug})}}});
    ASSERT_TRUE(names) << describe(names.error());
    EXPECT_EQ(names->front(), "Move lamp and mug");
    Editing each;
    json moves = {lamp, mug};
    for (json& move : moves) move["op"] = "move_object";
    ASSERT_TRUE(each.apply(moves));
    EXPECT_EQ(together.state, each.state);
}

TEST(Operation, AMovedObjectIsKeptInTheProjectAndGoesBackExactly) {
    Editing editing;
    const auto say = [&](json fields) {
        fields["op"] = "move_object";
        fields["object"] = "mug";
        return editing.apply(json::array({fields}))->front();
    };
    EXPECT_EQ(say({{"offset", {0.1, 0, 0}}}), "Move mug");
    EXPECT_EQ(say({{"turn_deg", 33.3}}), "Turn mug");
    EXPECT_EQ(say({{"offset", {0.1, 0.2, 0}}, {"turn_deg", 12.5}}), "Move and turn mug");
    const auto saved = editsFromJson(json::parse(editsJson(editing.state.edits).dump()));
    ASSERT_TRUE(saved);
    EXPECT_EQ(*saved, editing.state.edits);
    EXPECT_EQ(saved->scene.changes.at(0).move->offset_m, Eigen::Vector3d(0.1, 0.2, 0));
    EXPECT_EQ(say({{"offset", {0, 0, 0}}, {"turn_deg", 0}}), "Put back mug");
    EXPECT_EQ(editing.state, ProjectState{});
}

// From (0, 0, 0) at 1 s to (2, 0, 1) with half a turn at 3 s, then at rest.
TEST(Operation, ATrackSaysWhereItsObjectIsAtATime) {
    Editing editing;
    ASSERT_TRUE(editing.apply({{{"op", "object_track"},
                                {"object", "mug"},
                                {"keys",
                                 {{{"time_s", 1}},
                                  {{"time_s", 3}, {"offset", {2, 0, 1}}, {"turn_deg", 180}},
                                  {{"time_s", 4}, {"offset", {2, 4, 1}}, {"turn_deg", 180}}}}}}));
    EXPECT_TRUE(sameGeometry({}, editing.state.edits.scene));
    EXPECT_EQ(editing.find(editing.scene(), "mug")->box.center,
              editing.find(editing.imported, "mug")->box.center);
    const auto saved = editsFromJson(json::parse(editsJson(editing.state.edits).dump()));
    ASSERT_TRUE(saved);
    EXPECT_EQ(*saved, editing.state.edits);

    const auto at = [&](double time_s) {
        EXPECT_TRUE(editing.apply(json::array({{{"op", "at_time"}, {"time_s", time_s}}})));
        const auto& move = editing.state.edits.scene.changes.at(0).move;
        return move ? *move : ObjectMove{};
    };
    EXPECT_EQ(at(0.5), ObjectMove{});
    EXPECT_EQ(at(1.0), ObjectMove{});
    EXPECT_TRUE(at(1.5).offset_m.isApprox(Eigen::Vector3d(0.5, 0, 0.25)));
    EXPECT_NEAR(at(1.5).turn_rad, 0.25 * std::numbers::pi, 1e-12);
    EXPECT_EQ(at(3.0).offset_m, Eigen::Vector3d(2, 0, 1));
    EXPECT_TRUE(at(3.25).offset_m.isApprox(Eigen::Vector3d(2, 1, 1)));
    EXPECT_EQ(at(100.0).offset_m, Eigen::Vector3d(2, 4, 1));
    const Eigen::Vector3d was = editing.find(editing.imported, "mug")->box.center;
    EXPECT_LT(
        (editing.find(editing.scene(), "mug")->box.center - was - Eigen::Vector3d(2, 4, 1)).norm(),
        1e-12);
    ASSERT_TRUE(
        editing.apply({{{"op", "at_time"}, {"time_s", 0}},
                       {{"op", "object_track"}, {"object", "mug"}, {"keys", json::array()}}}));
    EXPECT_EQ(editing.state, ProjectState{});
}

// Its pieces, or the merged object, would be at the file's positions again.
TEST(Operation, AMovedObjectIsNotRegrouped) {
    for (const json& operation :
         {json{{"op", "split"}, {"object", "pair"}},
          json{{"op", "merge"}, {"objects", {"pair", "mug"}}, {"name", "both"}}}) {
        Editing editing;
        ASSERT_TRUE(
            editing.apply({{{"op", "move_object"}, {"object", "pair"}, {"offset", {0.2, 0, 0}}}}));
        const auto result = editing.apply(json::array({operation}));
        ASSERT_FALSE(result) << operation.dump();
        EXPECT_NE(result.error().message.find("was moved"), std::string::npos);
    }
}

TEST(Operation, FindsItsObjectsInAChangedSceneOrWarns) {
    Editing editing;
    ASSERT_TRUE(editing.apply(
        {{{"op", "exclude"}, {"object", "mug"}}, {{"op", "exclude"}, {"object", "lamp"}}}));
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("chair").box({1, 1, 0.25}, {0.5, 0.5, 0.5});
    builder.object("mug").box({2, 2.5, 0.05}, {0.1, 0.1, 0.1});
    const Result<Scene> changed = applySceneEdits(builder.build(), editing.state.edits.scene);
    ASSERT_TRUE(changed);
    EXPECT_EQ(changed->object(8).role, Role::Excluded);
    EXPECT_EQ(changed->object(7).role, Role::Target);
    ASSERT_EQ(changed->report.warnings.size(), 1U);
    EXPECT_NE(changed->report.warnings[0].find("lamp"), std::string::npos);
}

TEST(Operation, ATableEntryHasEverything) {
    EXPECT_EQ(listOperations().size(), 38U);
    for (const OperationInfo& info : listOperations()) {
        EXPECT_NE(info.apply, nullptr);
        EXPECT_FALSE(info.text.empty()) << info.op;
        for (const OperationField& field : info.fields) {
            EXPECT_FALSE(field.text.empty()) << info.op << " " << field.name;
        }
    }
}

}  // namespace dollytrack::operation_test
