#include "engine/document/command_stack.h"

#include "engine/document/edits_json.h"
#include "engine/document/operation.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace dollytrack::command_stack_test {
namespace {

using nlohmann::json;

ProjectState withFill(double fill) {
    ProjectState state;
    state.parameters["viewpoints"]["fill"] = fill;
    return state;
}

Status setAnything(json& parameters, const std::string& name, const json& value) {
    parameters["all"][name] = value;
    return {};
}

/// A random operation that may or may not be valid in a scene.
json anyOperation() {
    static const std::vector<std::string> names = {"sofa",    "table", "mug",    "book",
                                                   "picture", "floor", "corner", "table_1"};
    const auto object = [] { return *rc::gen::elementOf(names); };
    const auto number = [](int low, int high) { return 0.1 * *rc::gen::inRange(low, high); };
    const auto point = [&] { return json{number(0, 40), number(0, 30), number(1, 25)}; };
    switch (*rc::gen::inRange(0, 13)) {
        case 0:
            return {{"op", "exclude"}, {"object", object()}};
        case 1:
            return {{"op", "include"}, {"object", object()}};
        case 2:
            return {{"op", "set_class"}, {"object", object()}, {"class", *rc::gen::inRange(1, 41)}};
        case 3:
            return {{"op", "set_front"}, {"object", object()}, {"front", number(0, 3600)}};
        case 4:
            return {{"op", "reset_object"}, {"object", object()}};
        case 5:
            return {{"op", "merge"}, {"objects", {object(), object()}}, {"name", "corner"}};
        case 6:
            return {{"op", "split"}, {"object", object()}};
        case 7:
            return {
                {"op", "pin"}, {"objects", {object()}}, {"position", point()}, {"target", point()}};
        case 8:
            return {{"op", "remove_point"}, {"objects", {object(), object()}}};
        case 9:
            return {{"op", "add_no_go"},
                    {"center", point()},
                    {"size", point()},
                    {"yaw_deg", number(0, 900)}};
        case 10:
            return {{"op", "remove_no_go"}, {"name", "no-go box"}};
        case 11:
            return {{"op", "move_object"},
                    {"object", object()},
                    {"offset", point()},
                    {"turn_deg", number(-1800, 1800)}};
        default:
            return {{"op", "set"}, {"name", "fill"}, {"value", number(1, 10)}};
    }
}

}  // namespace

TEST(CommandStack, UndoAndRedoGoThroughEqualStates) {
    CommandStack stack(withFill(0.6));
    stack.push("Set fill to 0.5", withFill(0.5));
    stack.push("Set fill to 0.4", withFill(0.4));
    EXPECT_EQ(stack.undoName(), "Set fill to 0.4");
    EXPECT_EQ(*stack.undo(), withFill(0.5));
    EXPECT_EQ(stack.redoName(), "Set fill to 0.4");
    EXPECT_EQ(*stack.undo(), withFill(0.6));
    EXPECT_FALSE(stack.canUndo());
    EXPECT_EQ(*stack.undo(), withFill(0.6));
    EXPECT_EQ(*stack.goTo(2), withFill(0.4));
    EXPECT_EQ(stack.names(),
              (std::vector<std::string>{"Open", "Set fill to 0.5", "Set fill to 0.4"}));
}

TEST(CommandStack, ADragIsOneStep) {
    CommandStack stack(withFill(0.6));
    for (const double fill : {0.55, 0.5, 0.45}) stack.push("Set fill", withFill(fill), "fill");
    stack.endMerge();
    stack.push("Set fill", withFill(0.3), "fill");
    EXPECT_EQ(stack.names().size(), 3U);
    EXPECT_EQ(*stack.undo(), withFill(0.45));
    EXPECT_EQ(*stack.undo(), withFill(0.6));
    // After an undo, dragging the same slider is a new step.
    stack.push("Set fill", withFill(0.2), "fill");
    EXPECT_EQ(stack.names().size(), 2U);
    EXPECT_EQ(*stack.undo(), withFill(0.6));
}

TEST(CommandStack, ADragBackToItsBeginningIsNoStep) {
    CommandStack stack(withFill(0.6));
    stack.push("Set fill", withFill(0.5), "fill");
    stack.push("Set fill", withFill(0.6), "fill");
    EXPECT_FALSE(stack.canUndo());
    stack.push("Set fill", withFill(0.6));
    EXPECT_FALSE(stack.canUndo());
}

TEST(CommandStack, KnowsWhetherTheStateIsSaved) {
    CommandStack stack(withFill(0.6));
    EXPECT_TRUE(stack.isSaved());
    stack.push("Set fill", withFill(0.5));
    EXPECT_FALSE(stack.isSaved());
    stack.markSaved();
    stack.undo();
    EXPECT_FALSE(stack.isSaved());
    stack.redo();
    EXPECT_TRUE(stack.isSaved());
    stack.push("Set fill", withFill(0.6));
    stack.push("Set fill", withFill(0.5));
    EXPECT_TRUE(stack.isSaved());  // equal to the saved state, whatever the history
}

TEST(CommandStack, ACancelledDragLeavesUndoneStepsToRedo) {
    CommandStack stack;
    stack.push("Set fill", withFill(0.5));
    stack.undo();
    const CommandStack::History before = stack.history();
    stack.push("Set fill", withFill(0.7), "drag");
    EXPECT_FALSE(stack.canRedo());
    EXPECT_EQ(*stack.rewind(before), ProjectState());
    EXPECT_TRUE(stack.isSaved());
    EXPECT_EQ(*stack.redo(), withFill(0.5));
    EXPECT_FALSE(stack.canRedo());
}

RC_GTEST_PROP(CommandStack, UndoesRedoesAndSavesAnyOperations, ()) {
    static const Scene imported = test::furnishedRoom();
    CommandStack stack;
    std::vector<ProjectState> history = {*stack.state()};
    const int count = *rc::gen::inRange(0, 25);
    for (int i = 0; i < count; ++i) {
        ProjectState next = *stack.state();
        const ProjectState before = next;
        const auto names =
            applyOperations(next, imported, setAnything, json::array({anyOperation()}));
        if (!names) RC_ASSERT(next == before);
        if (next == before) continue;
        stack.push(names->front(), next);
        history.push_back(next);
        // The edits are equal after saving and loading, and can be applied to the scene.
        const auto back = editsFromJson(json::parse(editsJson(next.edits).dump()));
        RC_ASSERT(back.has_value());
        RC_ASSERT(*back == next.edits);
        const auto scene = applySceneEdits(imported, next.edits.scene);
        RC_ASSERT(scene.has_value());
        RC_ASSERT(scene->report.warnings.empty());
        RC_ASSERT(scene->triangles.size() == imported.triangles.size());
    }
    for (auto state = history.rbegin() + 1; state != history.rend(); ++state) {
        RC_ASSERT(*stack.undo() == *state);
    }
    RC_ASSERT(!stack.canUndo());
    for (std::size_t i = 1; i < history.size(); ++i) RC_ASSERT(*stack.redo() == history[i]);
    RC_ASSERT(!stack.canRedo());
}

}  // namespace dollytrack::command_stack_test
