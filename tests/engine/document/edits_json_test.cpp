#include "engine/document/edits_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dollytrack::edits_json_test {
namespace {

using nlohmann::json;

Edits someEdits() {
    Edits edits;
    edits.scene.definitions.push_back(
        {ObjectDefinition::Kind::Merge, {{3, "a"}, {5, "b"}}, "ab", 12, {}});
    edits.scene.definitions.push_back({ObjectDefinition::Kind::Split, {{3, "ab"}}, "ab", 0, {}});
    ObjectChange change;
    change.object = {4, "lamp \u00e9"};
    change.role = Role::Excluded;
    change.front = Eigen::Vector3d(std::cos(0.1), std::sin(0.1), 0.0);
    change.large = false;
    edits.scene.changes.push_back(change);
    edits.plan.pinned.push_back(
        {"window", lookAt({0.1, 0.2, 1.0 / 3.0}, {2, 1, 0.7}), {{4, "lamp"}}});
    edits.plan.removed.push_back({{{1, "x"}, {2, "y"}}});
    edits.plan.no_go.push_back({"stairs", {{0.1, 1.0 / 3.0, 0}, {0.5, 0.7, 1.1}, 0.3}});
    return edits;
}

}  // namespace

TEST(EditsJson, ComesBackToTheLastBit) {
    const Edits edits = someEdits();
    const Result<Edits> back = editsFromJson(json::parse(editsJson(edits).dump()));
    ASSERT_TRUE(back) << describe(back.error());
    EXPECT_EQ(*back, edits);
}

TEST(EditsJson, NoEditsAreAnEmptySection) {
    EXPECT_EQ(editsJson({}), json::object());
    EXPECT_EQ(*editsFromJson(json::object()), Edits{});
    EXPECT_EQ(*editsFromJson(nullptr), Edits{});
}

TEST(EditsJson, KeepsKeysItDoesNotKnow) {
    json section = editsJson(someEdits());
    section["lights"] = {1, 2};
    EXPECT_EQ(editsJson(*editsFromJson(section), section), section);
}

TEST(EditsJson, BadValuesAreNamedWithTheirPlace) {
    const auto error = [](auto&& spoil) {
        json section = editsJson(someEdits());
        spoil(section);
        const Result<Edits> result = editsFromJson(section);
        EXPECT_FALSE(result) << section.dump();
        return result ? Error{} : result.error();
    };
    EXPECT_EQ(error([](json& s) { s["version"] = 2; }).where, "edits.version");
    EXPECT_EQ(error([](json& s) { s.erase("version"); }).where, "edits.version");
    EXPECT_EQ(error([](json& s) {
                  s["pinned"][0]["position"] = {1, 2};
              }).where,
              "edits.pinned[0].position");
    EXPECT_EQ(error([](json& s) { s["pinned"][0]["position"][1] = nullptr; }).where,
              "edits.pinned[0].position[1]");
    EXPECT_EQ(error([](json& s) {
                  s["pinned"][0]["quaternion_xyzw"] = {0, 0.6, 0, 0.8};
              }).where,
              "edits.pinned[0].quaternion_xyzw");
    EXPECT_EQ(error([](json& s) { s["pinned"].push_back(s["pinned"][0]); }).where,
              "edits.pinned[1].name");
    EXPECT_EQ(error([](json& s) { s["no_go"][0]["half_size_m"][2] = 0; }).where,
              "edits.no_go[0].half_size_m");
    EXPECT_EQ(error([](json& s) { s["changes"][0]["role"] = "structure"; }).where,
              "edits.changes[0].role");
    EXPECT_EQ(error([](json& s) {
                  s["changes"][0]["front"] = {1, 1, 0};
              }).where,
              "edits.changes[0].front");
    EXPECT_EQ(error([](json& s) { s["changes"][0]["object"]["id"] = 0; }).where,
              "edits.changes[0].object.id");
    EXPECT_EQ(error([](json& s) { s["definitions"][1]["kind"] = "melt"; }).where,
              "edits.definitions[1].kind");
    EXPECT_EQ(error([](json& s) { s["removed"] = 7; }).where, "edits.removed");
    EXPECT_EQ(error([](json& s) { s = json::array(); }).where, "edits");
    EXPECT_EQ(error([](json& s) { s["version"] = 9; }).code, ErrorCode::BadInput);
}

}  // namespace dollytrack::edits_json_test
