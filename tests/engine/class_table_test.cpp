#include "engine/scene/class_table.h"
#include "engine/document/apply_scene_edits.h"
#include "engine/document/target_filter.h"
#include "engine/io/settings/class_table_file.h"
#include "engine/scene/labels.h"
#include "engine/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace dollytrack::class_table_test {
namespace {

using nlohmann::json;

ClassTable tableOf(const char* text) {
    Result<ClassTable> table = classTableFromJson(json::parse(text), "classes.json");
    if (!table) ADD_FAILURE() << describe(table.error());
    return table ? std::move(*table) : ClassTable({}, std::nullopt, 0);
}

constexpr const char* kSeats = R"({"classes": [
    {"id": 7, "name": "stool", "matches": ["*stool*"]},
    {"id": 3, "name": "seat", "matches": ["chair", "*sofa*", "coffee table"]},
    {"id": 0, "name": "Lamp"}
]})";

TEST(ClassTable, TheFirstClassThatFitsCounts) {
    const ClassTable table = tableOf(kSeats);
    const auto nameOf = [&](const char* object, const char* nyu40) {
        return table.classFor(object, nyu40FromName(nyu40)).name;
    };
    EXPECT_EQ(nameOf("Bar_Stool_02", "chair"), "stool") << "before seat, in the file's order";
    EXPECT_EQ(nameOf("Fauteuil", "chair"), "seat") << "by its NYU40 class";
    EXPECT_EQ(nameOf("chair", "desk"), "void") << "an NYU40 name means the class, not the name";
    EXPECT_EQ(nameOf("SOFA.001", ""), "seat") << "by its name, case aside";
    EXPECT_EQ(nameOf("CoffeeTable_01.003", "table"), "seat") << "by its words";
    EXPECT_EQ(nameOf("coffee_table_book", "books"), "void") << "a pattern is for the whole name";
    EXPECT_EQ(nameOf("Tripod", "lamp"), "Lamp") << "a class without patterns is found by its name";
}

TEST(ClassTable, WhatFitsNothingIsVoidOrTheOtherClass) {
    ClassTable table = tableOf(kSeats);
    EXPECT_EQ(table.boxClassFor("mug", 0), nullptr) << "no boxes";
    EXPECT_EQ(table.classFor("mug", 0).id, 255) << "a class has 0, and masks stay 8-bit";
    EXPECT_FALSE(table.isWide());

    json with_other = json::parse(kSeats);
    with_other["other"] = "STOOL";
    table = *classTableFromJson(with_other, "");
    EXPECT_EQ(table.classFor("mug", 0).name, "stool");
    EXPECT_EQ(table.indexOf(*table.boxClassFor("mug", 0)), 0);
    with_other["other"] = 3;
    EXPECT_EQ(classTableFromJson(with_other, "")->classFor("mug", 0).name, "seat");
    with_other["other"] = "ignore";
    EXPECT_EQ(classTableFromJson(with_other, "")->boxClassFor("mug", 0), nullptr);
}

TEST(ClassTable, MasksAreAsWideAsTheLargestIdNeeds) {
    EXPECT_FALSE(tableOf(R"({"classes": [{"id": 255, "name": "a"}]})").isWide());
    EXPECT_TRUE(tableOf(R"({"classes": [{"id": 256, "name": "a"}]})").isWide());
    EXPECT_TRUE(tableOf(R"({"classes": [{"id": 1, "name": "a"}], "void": 300})").isWide());
    const ClassTable full =
        tableOf(R"({"classes": [{"id": 0, "name": "a"}, {"id": 255, "name": "b"}]})");
    EXPECT_EQ(full.voidClass().id, 65535);
    EXPECT_TRUE(full.isWide());
}

TEST(ClassTable, ColoursThatAreNotGivenAreDistinct) {
    json many = {{"classes", {{{"id", 0}, {"name", "given"}, {"color", "#FF8000"}}}}};
    for (int id = 1; id < 400; ++id) {
        many["classes"].push_back({{"id", id}, {"name", "class " + std::to_string(id)}});
    }
    const Result<ClassTable> table = classTableFromJson(many, "");
    ASSERT_TRUE(table);
    std::set<std::array<std::uint8_t, 3>> colors = {table->voidClass().color};
    for (const DatasetClass& one : table->classes()) colors.insert(one.color);
    EXPECT_EQ(colors.size(), 401U);
    EXPECT_EQ(table->classes()[0].color, (std::array<std::uint8_t, 3>{255, 128, 0}));
}

TEST(ClassTable, ItsJsonMakesTheSameTable) {
    const auto once = classTableToJson(tableOf(kSeats));
    const auto twice = classTableToJson(tableOf(once.dump().c_str()));
    EXPECT_EQ(once.dump(), twice.dump());
    EXPECT_EQ(once["void"], 255);
    EXPECT_EQ(once["classes"][2]["matches"], json::array({"Lamp"}));
}

TEST(ClassTable, Nyu40IsTheDefault) {
    const ClassTable& table = Scene().classes();
    ASSERT_TRUE(table.isNyu40());
    ASSERT_EQ(table.classes().size(), 40U);
    for (int id = 1; id <= kNyu40Count; ++id) {
        const DatasetClass& of = table.classFor("anything", id);
        EXPECT_EQ(of.id, id);
        EXPECT_EQ(of.name, nyu40Name(id));
        EXPECT_EQ(table.indexOf(of), id - 1);
    }
    EXPECT_EQ(table.classFor("", 0).id, 0);
    EXPECT_EQ(table.boxClassFor("", 0)->name, "otherprop");
}

TEST(ClassTable, ObjectsFollowEditsOfTheirClass) {
    Scene scene;
    scene.objects.resize(2);
    scene.objects[0].name = "thing";
    scene.objects[1].name = "BarStool";
    for (int id : {1, 2}) scene.objects[id - 1].id = id;
    scene.class_table = std::make_shared<const ClassTable>(tableOf(kSeats));
    assignDatasetClasses(scene);
    EXPECT_EQ(scene.objects[0].dataset_class->name, "void");

    SceneEdits edits;
    edits.changes.emplace_back();
    edits.changes[0].object = {1, "thing"};
    edits.changes[0].nyu40 = nyu40FromName("chair");
    edits.ignore = {"stool"};
    const Result<Scene> edited = applySceneEdits(scene, edits, {});
    ASSERT_TRUE(edited);
    EXPECT_EQ(edited->objects[0].dataset_class->name, "seat");
    EXPECT_TRUE(edited->objects[1].role == Role::Excluded) << "the class's name is a pattern";
    EXPECT_TRUE(isClassName(scene, "LAMP")) << "one that the scene has no object of is no slip";
}

struct BadTable {
    const char* text;
    const char* where;
    const char* words;
};

class BadTables : public testing::TestWithParam<BadTable> {};

TEST_P(BadTables, AreRefusedWithTheirPlace) {
    const Result<ClassTable> table =
        classTableFromJson(json::parse(GetParam().text), "classes.json");
    ASSERT_FALSE(table);
    EXPECT_EQ(table.error().where, std::string("classes.json") + GetParam().where);
    EXPECT_NE(table.error().message.find(GetParam().words), std::string::npos)
        << table.error().message;
    EXPECT_TRUE(table.error().code == ErrorCode::BadInput);
    EXPECT_LE(std::ranges::count(table.error().message, ' '), 24);
}

INSTANTIATE_TEST_SUITE_P(
    Tables, BadTables,
    testing::Values(
        BadTable{"{}", ": classes", "at least one class"}, BadTable{"[]", "", "object"},
        BadTable{R"({"classes": []})", ": classes", "at least one class"},
        BadTable{R"({"classes": [{"id": 1, "name": "a"}, {"id": 1, "name": "b"}]})",
                 ": classes[1].id", "'a' also has the id 1"},
        BadTable{R"({"classes": [{"id": 1, "name": "a b"}, {"id": 2, "name": "A_b"}]})",
                 ": classes[1].name", "Another class"},
        BadTable{R"({"classes": [{"id": 65536, "name": "a"}]})", ": classes[0].id", "0 to 65535"},
        BadTable{R"({"classes": [{"id": -1, "name": "a"}]})", ": classes[0].id", "0 to 65535"},
        BadTable{R"({"classes": [{"id": 1.5, "name": "a"}]})", ": classes[0].id", "whole number"},
        BadTable{R"({"classes": [{"name": "a"}]})", ": classes[0].id", "number"},
        BadTable{R"({"classes": [{"id": 1}]})", ": classes[0].name", "text"},
        BadTable{R"({"classes": [{"id": 1, "name": "a\nb"}]})", ": classes[0].name", "control"},
        BadTable{R"({"classes": [{"id": 1, "name": "Void"}]})", ": classes[0].name", "void"},
        BadTable{R"({"classes": [{"id": 1, "name": "a", "color": "red"}]})", ": classes[0].color",
                 "#rrggbb"},
        BadTable{R"({"classes": [{"id": 1, "name": "a", "color": [1, 2, 256]}]})",
                 ": classes[0].color[2]", "0 to 255"},
        BadTable{R"({"classes": [{"id": 1, "name": "a", "matches": "b"}]})", ": classes[0].matches",
                 "list"},
        BadTable{R"({"classes": [{"id": 1, "name": "a", "colour": "#000000"}]})", ": classes[0]",
                 "'color'"},
        BadTable{R"({"classes": [{"id": 1, "name": "seat"}], "other": "seats"})", ": other",
                 "did you mean 'seat'"},
        BadTable{R"({"classes": [{"id": 1, "name": "a"}], "other": 2})", ": other", "this id"},
        BadTable{R"({"classes": [{"id": 1, "name": "a"}], "void": 1})", ": void", "'a'"},
        BadTable{R"({"classes": [{"id": 1, "name": "a"}], "version": 2})", ": version", "newer"},
        BadTable{R"({"words": ["mug,box"], "other": "ignore"})", ": other", "classes"}));

}  // namespace
}  // namespace dollytrack::class_table_test
