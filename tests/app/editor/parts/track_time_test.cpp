#include "app/editor/timeline/track_time.h"

#include "engine/document/object_track.h"

#include <gtest/gtest.h>

namespace dollytrack::editor::track_time_test {
namespace {

SceneEdits driving() {
    ObjectChange change;
    change.object = {1, "cart"};
    change.track = {{0.0, {}}, {4.0, {{4, 0, 0}, 0.0}}};
    SceneEdits edits;
    edits.changes = {change};
    return edits;
}

TEST(TrackTime, FollowsWhereThingsAre) {
    SceneEdits edits = driving();
    TrackTime time;
    putAtTime(edits, 3.0);
    time.follow(edits);
    EXPECT_NEAR(time.now(), 3.0, 1e-9);
    edits.changes[0].move->offset_m.z() = 1.0;
    time.follow(edits);
    EXPECT_NEAR(time.now(), 3.0, 1e-9) << "nothing tells another time";
    EXPECT_FALSE(time.isThere());
    time.follow({});
    EXPECT_TRUE(time.isThere()) << "without tracks nothing is out of place";
}

TEST(TrackTime, PlaysNoFasterThanPlansCome) {
    TrackTime time;
    time.toggle(4.0);
    EXPECT_FALSE(time.advance(0.5, 4.0, false));
    EXPECT_FALSE(time.advance(0.503, 4.0, false));
    EXPECT_EQ(time.advance(0.5, 4.0, true), 1.5) << "the time that went by while one planned";
    EXPECT_TRUE(time.playing());
    EXPECT_EQ(time.advance(9.0, 4.0, true), 4.0);
    EXPECT_FALSE(time.playing());
    time.toggle(4.0);
    EXPECT_EQ(time.advance(0.25, 4.0, true), 0.25) << "from the beginning again";
    time.goTo(2.0);
    EXPECT_FALSE(time.playing()) << "who takes the slider stops it";
}

}  // namespace
}  // namespace dollytrack::editor::track_time_test
