#include "ui/panels/plan/comparison_section.h"

#include "tests/ui/screen.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dollytrack::ui::comparison_section_test {
namespace {

/// The section with its input, and the last actions of the user.
struct Section {
    ComparisonView view;
    ComparisonActions done;
    test::Screen screen{[this] {
                            const ComparisonActions now = drawComparison(view);
                            done.keep |= now.keep;
                            done.open |= now.open;
                            done.swap |= now.swap;
                            done.drop |= now.drop;
                            done.cancel_reading |= now.cancel_reading;
                        },
                        330, 700};
};

}  // namespace

TEST(ComparisonSection, OffersToKeepAPlanFirst) {
    Section section;
    section.screen.frame(2);
    EXPECT_FALSE(section.screen.shows("comparison.swap"));
    EXPECT_FALSE(section.screen.shows("comparison.drop"));
    ASSERT_TRUE(section.screen.click("comparison.keep")) << section.screen.names();
    EXPECT_TRUE(section.done.keep);
    ASSERT_TRUE(section.screen.click("comparison.open"));
    EXPECT_TRUE(section.done.open);
    section.view.why_not_keep = "The plan is not ready yet.";
    section.done = {};
    section.screen.frame();
    EXPECT_FALSE(section.screen.enabled("comparison.keep"));
    section.screen.click("comparison.keep");
    EXPECT_FALSE(section.done.keep);
}

TEST(ComparisonSection, TheReadingOfAProjectCanBeCancelled) {
    Section section;
    section.screen.frame(2);
    EXPECT_FALSE(section.screen.shows("comparison.cancel_reading"));
    section.view.reading = "a project whose name is too long for the panel to show it.dolly";
    section.screen.frame();
    const auto cancel = section.screen.find("comparison.cancel_reading");
    ASSERT_TRUE(cancel) << section.screen.names();
    EXPECT_LE(cancel->right, 330.0F);
    ASSERT_TRUE(section.screen.click("comparison.cancel_reading"));
    EXPECT_TRUE(section.done.cancel_reading);
}

TEST(ComparisonSection, ListsTheMetricsOfBothPlans) {
    Section section;
    section.view.has_kept = true;
    section.view.kept_name = "Set fill to 0.5";
    const nlohmann::json a = {{"capture_rate", 0.9}, {"frames", 100}};
    const nlohmann::json b = {{"capture_rate", 0.8}, {"path_length_m", 3.0}};
    section.view.metrics = planning::comparePlans({a, {}}, {b, {}});
    section.screen.frame(2);
    for (const char* name : {"comparison.capture_rate", "comparison.frames",
                             "comparison.path_length_m", "comparison.duration_s"}) {
        EXPECT_TRUE(section.screen.shows(name)) << name;
    }
    EXPECT_FALSE(section.screen.shows("comparison.repeat_rate"));
    ASSERT_TRUE(section.screen.click("comparison.swap")) << section.screen.names();
    EXPECT_TRUE(section.done.swap);
    ASSERT_TRUE(section.screen.click("comparison.drop"));
    EXPECT_TRUE(section.done.drop);
}

}  // namespace dollytrack::ui::comparison_section_test
