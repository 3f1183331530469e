#include "ui/panels/timeline/steps_panel.h"

#include "tests/ui/screen.h"

#include <gtest/gtest.h>
#include <imgui_internal.h>

namespace dollytrack::ui::steps_panel_test {
namespace {

using Kind = AlgorithmStep::Kind;

struct Steps {
    explicit Steps(std::initializer_list<Kind> kinds) {
        for (const Kind kind : kinds) {
            AlgorithmStep step;
            step.kind = kind;
            steps.add(step);
        }
        view.steps = &steps;
        view.serial = 1;
        view.describe = [](std::size_t i) { return "step " + std::to_string(i); };
    }
    void draw() {
        const StepsActions actions = drawStepsPanel(view, state);
        if (actions.go_to) view.taken = *actions.go_to;
        if (actions.toggle_play) view.playing = !view.playing;
    }
    AlgorithmSteps steps;
    StepsView view;
    StepsState state;
};

TEST(StepsPanel, GoesForwardAndBackToBothEnds) {
    Steps steps({Kind::Sample, Kind::Near, Kind::Edge, Kind::Accepted});
    test::Screen screen([&] { steps.draw(); }, 380, 600);
    EXPECT_FALSE(screen.enabled("steps.back"));
    const std::pair<const char*, std::size_t> clicks[] = {
        {"steps.forward", 1}, {"steps.forward", 2}, {"steps.back", 1}, {"steps.back", 0},
        {"steps.last", 4},    {"steps.first", 0},   {"steps.row.2", 3}};
    for (const auto& [name, taken] : clicks) {
        ASSERT_TRUE(screen.click(name)) << name << " among " << screen.names();
        EXPECT_EQ(steps.view.taken, taken) << name;
    }
    screen.click("steps.play");
    EXPECT_TRUE(steps.view.playing);
    screen.click("steps.last");
    EXPECT_FALSE(screen.enabled("steps.forward"));
}

// The slider is below the buttons that move it, so their tooltips go above.
TEST(StepsPanel, TipsAtTheBottomOfTheWindowAreAboveTheirButtons) {
    Steps steps({Kind::Sample, Kind::Near});
    test::Screen screen(
        [&] {
            ImGui::SetCursorPosY(520);
            steps.draw();
        },
        1280, 720);
    for (const char* name : {"steps.forward", "steps.next_refusal"}) {
        ASSERT_TRUE(screen.hover(name));
        screen.frame(2);
        const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
        ASSERT_TRUE(tip != nullptr && tip->Active) << name;
        EXPECT_LE(tip->Pos.y + tip->Size.y, screen.find(name)->top) << name;
    }
}

TEST(StepsPanel, StopsOnlyAtTheKindsShown) {
    Steps steps({Kind::Sample, Kind::Near, Kind::Edge, Kind::Accepted, Kind::Sample, Kind::Near});
    test::Screen screen([&] { steps.draw(); }, 380, 600);
    for (const char* name : {"Near", "Edge", "CollisionFree"}) {
        ASSERT_TRUE(screen.click(std::string("steps.show.") + name)) << screen.names();
    }
    EXPECT_FALSE(screen.shows("steps.row.1"));
    EXPECT_TRUE(screen.shows("steps.row.4"));
    screen.click("steps.forward");
    screen.click("steps.forward");
    EXPECT_EQ(steps.view.taken, 5U);
    EXPECT_FALSE(screen.enabled("steps.forward"));
    screen.click("steps.back");
    EXPECT_EQ(steps.view.taken, 1U);
}

TEST(StepsPanel, FindsTheNextRefusal) {
    Steps steps({Kind::Edge, Kind::Refused, Kind::Edge, Kind::Accepted, Kind::Refused});
    test::Screen screen([&] { steps.draw(); }, 380, 600);
    screen.click("steps.next_refusal");
    EXPECT_EQ(steps.view.taken, 2U);
    screen.click("steps.next_refusal");
    EXPECT_EQ(steps.view.taken, 5U);
    EXPECT_FALSE(screen.enabled("steps.next_refusal"));
}

TEST(StepsPanel, TakesANewPlansStepsAndKeepsTheFilter) {
    Steps steps({Kind::Sample, Kind::Near});
    test::Screen screen([&] { steps.draw(); }, 380, 600);
    screen.click("steps.show.Near");
    steps.steps.steps[0].kind = Kind::Near;
    steps.steps.steps[1].kind = Kind::Sample;
    steps.view.serial = 2;
    screen.frame(2);
    EXPECT_FALSE(screen.shows("steps.row.0"));
    EXPECT_TRUE(screen.shows("steps.row.1"));
}

TEST(StepsPanel, HasAGroupForEveryKind) {
    for (int kind = 0; kind <= static_cast<int>(Kind::Visit); ++kind) {
        EXPECT_LT(static_cast<std::size_t>(groupOf(static_cast<Kind>(kind))), kStepGroups);
    }
    EXPECT_EQ(groupOf(Kind::Refused), StepGroup::CollisionFree);
    EXPECT_EQ(groupOf(Kind::LinkSample), StepGroup::Link);
    EXPECT_EQ(groupOf(Kind::Visit), StepGroup::Branch);
}

}  // namespace
}  // namespace dollytrack::ui::steps_panel_test
