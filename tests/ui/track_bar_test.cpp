#include "ui/panels/timeline/track_bar.h"

#include "tests/ui/screen.h"

#include <gtest/gtest.h>

namespace dollytrack::ui::track_bar_test {
namespace {

/// A row as the editor uses it: requests are carried out.
struct TrackBar {
    void draw() {
        const TrackBarActions actions = drawTrackBar(view);
        if (actions.go_to_s) view.time_s = *actions.go_to_s;
        if (actions.toggle_play) view.playing = !view.playing;
        finished += actions.finished ? 1 : 0;
    }
    TrackBarView view;
    int finished = 0;
};

TEST(TrackBar, SlidesToATimeAndTakesALaterOneByNumber) {
    TrackBar bar;
    bar.view.last_s = 8.0;
    bar.view.keys_s = {0.0, 8.0};
    test::Screen screen([&] { bar.draw(); }, 900, 60);
    screen.drag("tracks.slider", 0, 0);
    EXPECT_NEAR(bar.view.time_s, 0.5 * trackBarEnd(8.0), 0.1);
    EXPECT_EQ(bar.finished, 1);
    screen.drag("tracks.slider", 2000, 0);
    EXPECT_EQ(bar.view.time_s, trackBarEnd(8.0));
    EXPECT_GT(trackBarEnd(8.0), 8.0) << "there is room for a later key";
    ASSERT_TRUE(screen.typeInto("tracks.time", "30"));
    EXPECT_EQ(bar.view.time_s, 30.0);
    EXPECT_FALSE(screen.shows("tracks.elsewhere"));
    bar.view.is_there = false;
    screen.frame();
    EXPECT_TRUE(screen.shows("tracks.elsewhere"));
}

TEST(TrackBar, PlaysWhereThereIsSomethingToPlay) {
    TrackBar bar;
    test::Screen screen([&] { bar.draw(); }, 900, 60);
    EXPECT_FALSE(screen.enabled("tracks.play"));
    bar.view.last_s = 2.0;
    screen.frame();
    ASSERT_TRUE(screen.click("tracks.play"));
    EXPECT_TRUE(bar.view.playing);
}

}  // namespace
}  // namespace dollytrack::ui::track_bar_test
