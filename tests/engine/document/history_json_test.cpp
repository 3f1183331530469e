#include "engine/document/history_json.h"

#include "engine/document/operation.h"
#include "tests/support/scene_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dollytrack::history_json_test {
namespace {

using nlohmann::json;

Status setAnyParameter(json& parameters, const std::string& name, const json& value) {
    parameters["all"][name] = value;
    return {};
}

/// A history with parameters and edits of several kinds, one of them undone.
CommandStack::History someWork() {
    const Scene scene = test::furnishedRoom();
    CommandStack stack;
    const json operations = {
        {{"op", "set"}, {"name", "fill"}, {"value", 0.1 + 0.2}},
        {{"op", "exclude"}, {"object", "sofa"}},
        {{"op", "merge"}, {"objects", {"mug", "book"}}, {"name", "still life"}},
        {{"op", "add_no_go"}, {"center", {1, 1, 1}}, {"size", {1, 1, 1}}, {"yaw_deg", 30}},
        {{"op", "remove_no_go"}, {"name", "no-go box"}},
    };
    for (const json& operation : operations) {
        ProjectState next = *stack.state();
        const auto names = applyOperations(next, scene, setAnyParameter, json::array({operation}));
        EXPECT_TRUE(names) << describe(names.error());
        if (names) stack.push(names->front(), next);
    }
    ProjectState in_feet = *stack.state();
    in_feet.import["unit_m"] = 0.3048;
    stack.push("Read the scene in feet", in_feet);
    stack.undo();
    return stack.history();
}

void expectSame(const CommandStack::History& one, const CommandStack::History& other) {
    EXPECT_EQ(one.position, other.position);
    ASSERT_EQ(one.steps.size(), other.steps.size());
    for (std::size_t i = 0; i < one.steps.size(); ++i) {
        EXPECT_EQ(one.steps[i].name, other.steps[i].name);
        EXPECT_EQ(*one.steps[i].state, *other.steps[i].state) << "step " << i;
    }
}

/// Converts to text and back, as when saving and loading.
Result<CommandStack::History> throughText(const json& written) {
    return historyFromJson(json::parse(written.dump()));
}

}  // namespace

TEST(HistoryJson, ReadsBackEveryStepAndThePlaceInThem) {
    const CommandStack::History work = someWork();
    ASSERT_EQ(work.steps.size(), 7U);
    const auto back = throughText(historyJson(work));
    ASSERT_TRUE(back) << describe(back.error());
    expectSame(*back, work);
}

TEST(HistoryJson, ManyStepsTakeLittleRoom) {
    CommandStack stack;
    ProjectState state;
    for (int i = 0; i < 200; ++i) state.parameters["all"][fmt::format("p{}", i)] = i;
    for (int i = 0; i < 150; ++i) {
        state.parameters["all"]["p7"] = 1000 + i;
        stack.push("Set p7", state);
    }
    const std::size_t one = json{{"parameters", state.parameters}}.dump().size();
    EXPECT_LT(historyJson(stack.history()).dump().size(), 2 * one + 150 * 150);
}

TEST(HistoryJson, LeavesAwayTheOldestButNeverThePresent) {
    CommandStack stack;
    for (int i = 1; i <= 10; ++i) {
        ProjectState state;
        state.parameters["n"] = i;
        stack.push(fmt::format("Set n to {}", i), state);
    }
    auto back = throughText(historyJson(stack.history(), 4));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->steps.size(), 4U);
    EXPECT_EQ(back->steps[back->position].state->parameters["n"], 10);
    EXPECT_EQ(back->steps.front().name, "Set n to 7");
    stack.goTo(2);
    back = throughText(historyJson(stack.history(), 4));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->position, 0U);
    EXPECT_EQ(back->steps.front().state->parameters["n"], 2);
    EXPECT_EQ(back->steps.size(), 9U);
}

TEST(HistoryJson, ReadsHistoriesWithoutImportSettings) {
    CommandStack stack;
    ProjectState state;
    state.parameters["n"] = 1;
    stack.push("Set n to 1", state);
    json written = historyJson(stack.history());
    written["steps"][0]["changes"].push_back({{"op", "remove"}, {"path", "/import"}});
    const auto read = throughText(written);
    ASSERT_TRUE(read) << describe(read.error());
    for (const CommandStack::Step& step : read->steps) EXPECT_TRUE(step.state->import.is_null());
}

TEST(HistoryJson, SaysWhichStepDoesNotFit) {
    const json good = historyJson(someWork());
    json no_place = good;
    no_place["position"] = 7;
    json no_patch = good;
    no_patch["steps"][3]["changes"] = {{{"op", "remove"}, {"path", "/nothing"}}};
    json no_edits = good;
    no_edits["steps"][2]["changes"] = {
        {{"op", "replace"}, {"path", "/edits"}, {"value", {{"pinned", 7}}}}};
    json no_import = good;
    no_import["steps"][0]["changes"].push_back({{"op", "add"}, {"path", "/import"}, {"value", 7}});
    for (const auto& [bad, place] : {std::pair{no_place, "steps[7]"},
                                     {no_patch, "steps[3]"},
                                     {no_edits, "steps[2]"},
                                     {no_import, "steps[0]"},
                                     {json(), "steps[0]"}}) {
        const auto read = historyFromJson(bad);
        ASSERT_FALSE(read) << place;
        EXPECT_EQ(read.error().code, ErrorCode::BadInput);
        EXPECT_NE(read.error().where.find(place), std::string::npos) << describe(read.error());
    }
}

TEST(HistoryJson, ARestoredStackGoesOn) {
    const CommandStack::History work = someWork();
    CommandStack stack;
    stack.restore(work);
    EXPECT_FALSE(stack.isSaved());
    EXPECT_EQ(stack.redoName(), work.steps.back().name);
    EXPECT_EQ(*stack.redo(), *work.steps.back().state);
    while (stack.canUndo()) stack.undo();
    EXPECT_EQ(*stack.state(), *work.steps.front().state);
}

}  // namespace dollytrack::history_json_test
