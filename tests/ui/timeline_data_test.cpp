#include "ui/panels/timeline/timeline_data.h"

#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace dollytrack::ui::timeline_data_test {
namespace {

TrajectoryFrame frameOf(int component, int path, int position_point) {
    TrajectoryFrame frame;
    frame.component = component;
    frame.path = path;
    frame.position_point = position_point;
    return frame;
}

Plan planOf(std::vector<TrajectoryFrame> frames) {
    Plan plan;
    plan.trajectory.frames = std::move(frames);
    plan.position_points.resize(2);
    plan.position_points[1].captured = {2, 3};
    return plan;
}

TEST(TimelineData, HasAKeyForEveryStay) {
    const Scene scene = test::furnishedRoom();
    const Plan plan = planOf({frameOf(0, 0, 0), frameOf(0, 0, 0), frameOf(0, 0, -1),
                              frameOf(0, 0, 1), frameOf(0, 0, 0), frameOf(0, 1, 0)});
    const std::vector<TimelineKey> keys = timelineKeys(scene, plan);
    ASSERT_EQ(keys.size(), 4U);
    EXPECT_EQ(keys[0].frame, 0);
    EXPECT_EQ(keys[0].text, "Captures nothing");
    EXPECT_EQ(keys[1].frame, 3);
    EXPECT_EQ(keys[1].text, "Captures " + scene.object(2).name + ", " + scene.object(3).name);
    EXPECT_EQ(keys[2].frame, 4);
    EXPECT_EQ(keys[3].frame, 5) << "the camera was carried over to another path";
}

TEST(TimelineData, CutsTheFramesIntoRoomsAndPaths) {
    const Plan plan = planOf({frameOf(0, 0, -1), frameOf(0, 0, -1), frameOf(1, 1, -1),
                              frameOf(1, 2, -1), frameOf(1, 2, -1)});
    const std::vector<TimelineBand> bands = timelineBands(plan);
    ASSERT_EQ(bands.size(), 3U);
    EXPECT_EQ(bands[0].name, "Room 1");
    EXPECT_EQ(bands[1].name, "Room 2, path 1");
    EXPECT_EQ(bands[2].name, "Room 2, path 2");
    EXPECT_EQ(bands[0].end, 2);
    EXPECT_EQ(bands[1].begin, 2);
    EXPECT_EQ(bands[2].end, 5);
    EXPECT_TRUE(timelineBands(planOf({})).empty());
}

}  // namespace
}  // namespace dollytrack::ui::timeline_data_test
