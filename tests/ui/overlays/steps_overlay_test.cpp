#include "ui/overlays/steps_overlay.h"

#include "tests/ui/overlays/planned_room.h"
#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <gtest/gtest.h>

#include <set>

namespace dollytrack::ui::steps_overlay_test {
namespace {

using Kind = AlgorithmStep::Kind;

const fixture::PlannedRoom& rooms() {
    static const fixture::PlannedRoom room =
        fixture::planRoom(dollytrack::test::twoRoomsWithDoor(0.7));
    return room;
}

const fixture::PlannedRoom& furnished() {
    static const fixture::PlannedRoom room = fixture::planRoom(dollytrack::test::furnishedRoom());
    return room;
}

std::set<int> tagged(const render::Overlay& overlay, Picked kind) {
    std::set<int> indices;
    for (const auto& line : overlay.lines) {
        if (fromTag(line.tag).kind == kind) indices.insert(fromTag(line.tag).index);
    }
    return indices;
}

int countOf(const Legend& legend, const std::string& name) {
    for (const LegendEntry& entry : legend.entries) {
        if (entry.name == name) return entry.count;
    }
    return 0;
}

TEST(StepsLayer, EndsWithTheRoadmap) {
    for (const auto* room : {&rooms(), &furnished()}) {
        const Roadmap& roadmap = room->plan->roadmap;
        const PlanLayer layer = stepsLayer(*room->plan, roadmap.steps.steps.size());
        EXPECT_EQ(tagged(layer.overlay, Picked::Edge).size(), roadmap.edges.size());
        EXPECT_EQ(tagged(layer.overlay, Picked::RefusedEdge).size(), roadmap.refused.size());
        int kept = 0;
        int links = 0;
        int dropped = 0;
        for (const RoadmapEdge& edge : roadmap.edges) {
            ++(!edge.in_tree ? dropped : edge.is_link ? links : kept);
        }
        EXPECT_EQ(countOf(layer.legend, "Accepted"), kept);
        EXPECT_EQ(countOf(layer.legend, "Link by RRT*"), links);
        EXPECT_EQ(countOf(layer.legend, "Dropped"), dropped);
        EXPECT_EQ(countOf(layer.legend, "RRT* sample"), static_cast<int>(roadmap.samples.size()));
        EXPECT_EQ(countOf(layer.legend, "Key frame, waiting"), 0);
    }
}

TEST(StepsLayer, BeginsWithKeyFramesAlone) {
    const Plan& plan = *furnished().plan;
    const PlanLayer layer = stepsLayer(plan, 0);
    EXPECT_TRUE(layer.overlay.lines.empty());
    EXPECT_EQ(layer.overlay.marks.size(), plan.key_frames.size());
    EXPECT_EQ(countOf(layer.legend, "Key frame, waiting"),
              static_cast<int>(plan.key_frames.size()));
}

TEST(StepsLayer, EachStepAddsWhatItSaysAndGoingBackTakesItAway) {
    const Plan& plan = *furnished().plan;
    const auto& steps = plan.roadmap.steps.steps;
    std::size_t edges = 0;
    std::size_t refused = 0;
    for (std::size_t k = 1; k <= steps.size(); ++k) {
        edges += steps[k - 1].kind == Kind::Accepted || steps[k - 1].kind == Kind::LinkFound;
        refused += steps[k - 1].kind == Kind::Refused;
        const PlanLayer layer = stepsLayer(plan, k);
        ASSERT_EQ(tagged(layer.overlay, Picked::Edge).size(), edges) << k;
        ASSERT_EQ(tagged(layer.overlay, Picked::RefusedEdge).size(), refused) << k;
        ASSERT_EQ(countOf(layer.legend, "This step"), 1);
    }
}

TEST(Describe, SaysEveryStepInOneSentence) {
    for (const auto* room : {&rooms(), &furnished()}) {
        std::set<Kind> seen;
        for (const AlgorithmStep& step : room->plan->roadmap.steps.steps) {
            const std::string text = describe(*room->scene, *room->plan, step);
            ASSERT_FALSE(text.empty());
            EXPECT_TRUE(text.back() == '.' || text.back() == '?') << text;
            EXPECT_EQ(text.find("nothing"), std::string::npos) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos);
            seen.insert(step.kind);
        }
        EXPECT_TRUE(seen.contains(Kind::Near));
    }
}

TEST(Describe, NamesTheTermsOfNear) {
    const auto& room = furnished();
    AlgorithmStep step{Kind::Near, 0, 1};
    step.distance_m = 2.0F;
    step.distance_cost = 2.0F;
    step.size_cost = 0.6F;
    step.turn_cost = 0.5F;
    EXPECT_EQ(describe(*room.scene, *room.plan, step),
              "Near: " + nameOf(*room.scene, *room.plan, 1) +
                  ", 2.00 m away, cost 3.10 = 2.00 distance + 0.60 size + 0.50 turn.");
}

}  // namespace
}  // namespace dollytrack::ui::steps_overlay_test
