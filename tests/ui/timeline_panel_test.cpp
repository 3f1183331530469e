#include "ui/panels/timeline/timeline_panel.h"

#include "ui/panels/timeline/timeline_strips.h"
#include "ui/panels/timeline/timeline_time.h"

#include "tests/ui/screen.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>

namespace dollytrack::ui::timeline_panel_test {
namespace {

/// A timeline as the editor uses it: requests are carried out.
struct Timeline {
    explicit Timeline(int count) {
        series.clearance_m.assign(count, 0.5);
        series.speed_mps = series.turn_dps = series.score = series.clearance_m;
        series.in_view.assign(count, 3);
        series.captured_so_far = series.in_view;
        series.newly_captured.resize(count);
        view.frame_count = count;
        view.series = &series;
        view.keys = &keys;
        view.bands = &bands;
    }

    void draw() {
        const TimelineActions actions = drawTimelinePanel(view, state);
        if (actions.go_to) view.frame = *actions.go_to;
        if (actions.toggle_play) view.playing = !view.playing;
    }

    FrameSeries series;
    std::vector<TimelineKey> keys = {{20, "Captures the bed"}, {100, ""}, {180, ""}};
    std::vector<TimelineBand> bands = {{0, 120, "Room 1"}, {120, 300, "Room 2"}};
    TimelineView view;
    TimelineState state;
};

void clickAt(test::Screen& screen, float x, float y) {
    ImGui::GetIO().MousePos = {x, y};
    screen.frame(2);
    ImGui::GetIO().MouseDown[0] = true;
    screen.frame();
    ImGui::GetIO().MouseDown[0] = false;
    screen.frame(2);
}

TEST(TimelinePanel, MovesWithItsButtons) {
    Timeline timeline(300);
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    EXPECT_FALSE(screen.enabled("timeline.back"));
    EXPECT_FALSE(screen.enabled("timeline.previous_key"));
    const std::pair<const char*, int> clicks[] = {
        {"timeline.forward", 1},        {"timeline.next_key", 20}, {"timeline.next_key", 100},
        {"timeline.previous_key", 20},  {"timeline.back", 19},     {"timeline.end", 299},
        {"timeline.previous_key", 180}, {"timeline.start", 0}};
    for (const auto& [name, frame] : clicks) {
        ASSERT_TRUE(screen.click(name)) << name << " among " << screen.names();
        EXPECT_EQ(timeline.view.frame, frame) << name;
    }
    screen.click("timeline.play");
    EXPECT_TRUE(timeline.view.playing);
    screen.click("timeline.loop");
    EXPECT_TRUE(timeline.state.loop);
    screen.click("timeline.speed");
    ASSERT_TRUE(screen.click("timeline.speed.4"));
    EXPECT_EQ(timeline.state.speed, 4.0);
}

// With few frames, half a frame lasts more than a second.
TEST(TimelinePanel, TheAxisAndThePlayheadAgree) {
    Timeline timeline(5);
    timeline.keys.clear();
    timeline.bands.clear();
    timeline.view.frame_interval_s = 2.0;
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    screen.frame(2);
    for (const int frame : {0, 1, 4}) {
        timeline.view.frame = frame;
        screen.frame(2);
        const auto playhead = screen.find("timeline.playhead");
        const auto tick = screen.find("timeline.tick." + std::to_string(2 * frame));
        ASSERT_TRUE(playhead && tick) << screen.names();
        EXPECT_NEAR(playhead->left, tick->left, 1.5) << frame;
    }
    EXPECT_FALSE(screen.shows("timeline.tick.-1"));
}

TEST(TimelinePanel, TakesAFrameAndATimeThatAreTyped) {
    Timeline timeline(300);
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    ASSERT_TRUE(screen.typeInto("timeline.frame", "123"));
    EXPECT_EQ(timeline.view.frame, 123);
    ASSERT_TRUE(screen.typeInto("timeline.time", "4.5"));
    EXPECT_EQ(timeline.view.frame, 45);
    ASSERT_TRUE(screen.typeInto("timeline.frame", "99999"));
    EXPECT_EQ(timeline.view.frame, 299);
}

TEST(TimelinePanel, GoesToTheFrameUnderTheMouse) {
    Timeline timeline(300);
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    const auto axis = screen.find("timeline.axis");
    ASSERT_TRUE(axis);
    const float width = axis->right - axis->left;
    for (const int frame : {0, 37, 150, 299}) {
        const float x = axis->left + width * (static_cast<float>(frame) + 0.5F) / 300.0F;
        clickAt(screen, x, axis->bottom - 5);
        EXPECT_EQ(timeline.view.frame, frame);
    }
    // Slightly beside a key frame's marker.
    const auto key = screen.find("timeline.key.100");
    ASSERT_TRUE(key);
    clickAt(screen, (key->left + key->right) / 2 + 5, (key->top + key->bottom) / 2);
    EXPECT_EQ(timeline.view.frame, 100);
}

/// A timeline with camera keys at 0, 5 and 10 s of a trajectory of 10 s. Requests are carried out.
struct KeyTimeline : Timeline {
    KeyTimeline() : Timeline(101) {
        keys = {{0, "Key 1"}, {50, "Key 2"}, {100, "Key 3"}};
        bands.clear();
        view.camera_keys = &camera_keys;
    }
    void draw() {
        const TimelineActions actions = drawTimelinePanel(view, state);
        if (actions.go_to) view.frame = *actions.go_to;
        if (actions.select_key) view.selected_key = *actions.select_key;
        if (actions.fly_to_key) flown_to = *actions.fly_to_key;
        if (!actions.retime) return;
        ++retimes;
        camera_keys[actions.retime->key].time_s = actions.retime->time_s;
        camera_keys[actions.retime->key].reached_s = actions.retime->time_s;
    }
    std::vector<TimelineCameraKey> camera_keys = {{0.0, 0.0, ""}, {5.0, 5.0, ""}, {10.0, 10.0, ""}};
    int flown_to = -1;
    int retimes = 0;
};

/// Pixels of a second on the axis, from the rulers' ticks.
float pixelsPerSecond(test::Screen& screen) {
    return (screen.find("timeline.tick.5")->left - screen.find("timeline.tick.0")->left) / 5.0F;
}

TEST(TimelinePanel, ACameraKeyIsSelectedByAClickAndGoneTo) {
    KeyTimeline timeline;
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    ASSERT_TRUE(screen.click("timeline.camera_key.1")) << screen.names();
    EXPECT_EQ(timeline.view.selected_key, 1);
    EXPECT_EQ(timeline.view.frame, 50);
    EXPECT_EQ(timeline.retimes, 0) << "a click retimes nothing";
    EXPECT_EQ(timeline.flown_to, -1);
    ASSERT_TRUE(screen.doubleClick("timeline.camera_key.2"));
    EXPECT_EQ(timeline.flown_to, 2);
    EXPECT_EQ(timeline.retimes, 0);
    EXPECT_FALSE(screen.shows("timeline.key.50")) << "it has only one marker";
}

TEST(TimelinePanel, ADragRetimesACameraKeyOnceToAWholeFrame) {
    KeyTimeline timeline;
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    screen.frame(2);
    const float second = pixelsPerSecond(screen);
    ASSERT_TRUE(screen.drag("timeline.camera_key.1", 2.03F * second, 0));
    EXPECT_EQ(timeline.retimes, 1);
    const double dragged_s = timeline.camera_keys[1].time_s;
    EXPECT_NEAR(dragged_s, 7.0, 0.11);
    EXPECT_NEAR(10.0 * dragged_s, std::round(10.0 * dragged_s), 1e-9);
    // Not past its neighbours.
    ASSERT_TRUE(screen.drag("timeline.camera_key.1", 6.0F * second, 0));
    EXPECT_NEAR(timeline.camera_keys[1].time_s, 9.9, 1e-9);
    ASSERT_TRUE(screen.drag("timeline.camera_key.1", -20.0F * second, 0));
    EXPECT_NEAR(timeline.camera_keys[1].time_s, 0.1, 1e-9);
    // The last one may be moved beyond the end of the trajectory.
    ASSERT_TRUE(screen.drag("timeline.camera_key.2", 1.5F * second, 0));
    EXPECT_NEAR(timeline.camera_keys[2].time_s, 11.5, 0.11);  // a pixel is about 10 ms
    EXPECT_EQ(timeline.retimes, 4);
}

TEST(TimelinePanel, EscapeCancelsTheDragOfACameraKey) {
    KeyTimeline timeline;
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    ASSERT_TRUE(screen.hover("timeline.camera_key.1"));
    ImGuiIO& io = ImGui::GetIO();
    io.MouseDown[0] = true;
    screen.frame();
    io.MousePos.x += 100;
    screen.frame(2);
    EXPECT_TRUE(timeline.state.dragged_to_s);
    screen.press(GLFW_KEY_ESCAPE);
    const int frame = timeline.view.frame;
    io.MousePos.x += 50;
    screen.frame(2);
    io.MouseDown[0] = false;
    screen.frame(2);
    EXPECT_EQ(timeline.retimes, 0);
    EXPECT_EQ(timeline.view.frame, frame) << "the rest of the drag must not scrub";
    EXPECT_EQ(timeline.camera_keys[1].time_s, 5.0);
}

// A key that is reached later than it should keeps its marker at its own time.
TEST(TimelinePanel, ALateKeyIsDraggedFromItsOwnTime) {
    KeyTimeline timeline;
    timeline.camera_keys[1] = {2.0, 5.0, "Key 2 is reached at 5 s instead of 2 s."};
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    screen.frame(2);
    const auto marker = screen.find("timeline.camera_key.1");
    ASSERT_TRUE(marker);
    const float tick = screen.find("timeline.tick.2")->left;
    EXPECT_NEAR((marker->left + marker->right) / 2, tick, 1.5);
    ASSERT_TRUE(screen.drag("timeline.camera_key.1", pixelsPerSecond(screen), 0));
    EXPECT_NEAR(timeline.camera_keys[1].time_s, 3.0, 0.11);
}

TEST(TimelinePanel, ZoomsWithTheWheelAndShowsAllAgain) {
    Timeline timeline(20'000);
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    EXPECT_FALSE(screen.enabled("timeline.fit"));
    screen.hover("timeline.axis");
    for (int i = 0; i < 10; ++i) {
        ImGui::GetIO().MouseWheel = 1.0F;
        screen.frame();
    }
    EXPECT_GT(timeline.state.shown, 0.0);
    EXPECT_LT(timeline.state.shown, 3000.0);
    const double first = timeline.state.first;
    ImGuiIO& io = ImGui::GetIO();
    io.MouseDown[2] = true;
    screen.frame();
    io.MousePos.x += 100;
    screen.frame();
    io.MouseDown[2] = false;
    screen.frame();
    EXPECT_LT(timeline.state.first, first);
    EXPECT_EQ(timeline.view.frame, 0) << "panning must not scrub";
    // The frame that plays is scrolled into view.
    timeline.view.frame = 19'000;
    screen.frame();
    EXPECT_GE(timeline.state.first + timeline.state.shown, 19'000.0);
    ASSERT_TRUE(screen.click("timeline.fit"));
    EXPECT_EQ(timeline.state.shown, 0.0);
}

TEST(TimelinePanel, SwitchesStrips) {
    Timeline timeline(300);
    timeline.state.strips.fill(true);
    test::Screen screen([&] { timeline.draw(); });
    screen.click("timeline.strips");
    ASSERT_TRUE(screen.click("timeline.strip.turn")) << screen.names();
    EXPECT_FALSE(timeline.state.strips[static_cast<std::size_t>(TimelineStrip::Turn)]);
}

TEST(TimelinePanel, ShowsImageCornersOnlyWhereTheyWereCounted) {
    Timeline timeline(300);
    EXPECT_FALSE(isShown(timeline.view, timeline.state, TimelineStrip::ImageCorners));
    EXPECT_TRUE(isShown(timeline.view, timeline.state, TimelineStrip::Speed));
    timeline.series.image_corners.assign(300, 220.0);
    EXPECT_TRUE(isShown(timeline.view, timeline.state, TimelineStrip::ImageCorners));
    EXPECT_EQ(stripText(timeline.view, TimelineStrip::ImageCorners, 7), "220");
    test::Screen screen([&] { timeline.draw(); });
    // While a plan is measured, the strip of the plan before stays.
    timeline.view.earlier = &timeline.series;
    timeline.view.series = nullptr;
    screen.frame();
    EXPECT_TRUE(isShown(timeline.view, timeline.state, TimelineStrip::ImageCorners));
    FrameSeries without = timeline.series;
    without.image_corners.clear();
    timeline.view.series = &without;
    EXPECT_FALSE(isShown(timeline.view, timeline.state, TimelineStrip::ImageCorners));
    ASSERT_TRUE(screen.click("timeline.strips"));
    EXPECT_FALSE(screen.enabled("timeline.strip.image_corners"));
    EXPECT_TRUE(screen.enabled("timeline.strip.speed"));
    timeline.view.series = &timeline.series;
    timeline.state.strips[static_cast<std::size_t>(TimelineStrip::ImageCorners)] = false;
    EXPECT_FALSE(isShown(timeline.view, timeline.state, TimelineStrip::ImageCorners));
}

TEST(TimelinePanel, ShowsOverlapAndImageCornersOfAMeasuredQuality) {
    Timeline timeline(300);
    EXPECT_FALSE(isShown(timeline.view, timeline.state, TimelineStrip::Overlap));
    FrameQuality quality;
    quality.image_corners.assign(300, 90.0);
    quality.overlap.assign(300, 0.875);
    timeline.view.quality = &quality;
    EXPECT_TRUE(isShown(timeline.view, timeline.state, TimelineStrip::Overlap));
    EXPECT_TRUE(isShown(timeline.view, timeline.state, TimelineStrip::ImageCorners));
    EXPECT_EQ(stripText(timeline.view, TimelineStrip::Overlap, 7), "0.88");
    EXPECT_EQ(stripText(timeline.view, TimelineStrip::ImageCorners, 7), "90");
    test::Screen screen([&] { timeline.draw(); });
    ASSERT_TRUE(screen.click("timeline.strips"));
    EXPECT_TRUE(screen.enabled("timeline.strip.overlap"));
}

// The strips must neither vanish nor move until the new values arrive.
TEST(TimelinePanel, KeepsTheStripsOfAQualityThatIsMeasuredAgain) {
    Timeline timeline(300);
    FrameQuality quality;
    quality.image_corners.assign(200, 90.0);  // of an earlier plan with 200 frames
    quality.overlap.assign(200, 0.875);
    const auto shows = [&](TimelineStrip strip) {
        return isShown(timeline.view, timeline.state, strip);
    };
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    const auto axisBottom = [&] {
        screen.frame(2);
        return screen.find("timeline.axis")->bottom;
    };
    const float without = axisBottom();
    for (const bool has_earlier : {true, false}) {
        timeline.view.earlier_quality = has_earlier ? &quality : nullptr;
        timeline.view.measures_quality = true;
        for (const TimelineStrip strip : {TimelineStrip::Overlap, TimelineStrip::ImageCorners}) {
            EXPECT_TRUE(shows(strip)) << has_earlier;
            EXPECT_FALSE(hasValues(timeline.view, strip)) << has_earlier;
        }
        EXPECT_TRUE(hasValues(timeline.view, TimelineStrip::Speed));
        const float waiting = axisBottom();
        EXPECT_GT(waiting, without) << "six rows instead of four";
        FrameQuality now;
        now.image_corners.assign(300, 70.0);
        now.overlap.assign(300, 0.5);
        timeline.view.quality = &now;
        timeline.view.measures_quality = false;
        EXPECT_TRUE(shows(TimelineStrip::Overlap));
        EXPECT_EQ(stripText(timeline.view, TimelineStrip::Overlap, 299), "0.50");
        EXPECT_EQ(axisBottom(), waiting);
        timeline.view.quality = nullptr;
    }
    EXPECT_FALSE(shows(TimelineStrip::Overlap)) << "the measurement has failed";
}

TEST(TimelinePanel, ShowsTheLengthOfTheKeptPlanOnTheSameAxis) {
    Timeline timeline(300);
    test::Screen screen([&] { timeline.draw(); }, 1280, 300);
    EXPECT_FALSE(screen.shows("timeline.kept"));
    timeline.view.kept_text = "180 frames, 18.0 s";
    timeline.view.kept_s = 180 * timeline.view.frame_interval_s;
    screen.frame(2);
    const ui::NamedItem axis = *screen.find("timeline.axis");
    const ui::NamedItem kept = *screen.find("timeline.kept");
    EXPECT_NEAR(kept.left, axis.left, 1.0F);
    EXPECT_NEAR(kept.right - kept.left, 0.6F * (axis.right - axis.left), 2.0F);
    timeline.view.kept_s = 1000.0;  // longer than the axis
    screen.frame(2);
    EXPECT_NEAR(screen.find("timeline.kept")->right, axis.right, 1.0F);
}

TEST(TimelineTime, FollowsTheTimesWhereFramesWereLeftOut) {
    const std::vector<double> times = {0.0, 0.1, 0.5, 0.6};
    TimelineView view;
    view.frame_count = 4;
    view.frame_interval_s = 0.1;
    EXPECT_NEAR(timeOf(view, 3), 0.3, 1e-12);
    view.times_s = &times;
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(timeOf(view, i), times[i]);
        EXPECT_NEAR(frameAt(view, times[i]), i, 1e-12);
    }
    EXPECT_NEAR(timeOf(view, 1.25), 0.2, 1e-12);
    EXPECT_NEAR(frameAt(view, 0.2), 1.25, 1e-12);
    EXPECT_NEAR(frameAt(view, 0.8), 5.0, 1e-12);
    EXPECT_NEAR(timeOf(view, -1.0), -0.1, 1e-12);
}

TEST(TimelinePanel, SaysWhyNothingCanBePlayed) {
    Timeline timeline(0);
    test::Screen screen([&] { timeline.draw(); }, 1280, 180);
    for (const char* name : {"timeline.play", "timeline.start", "timeline.end", "timeline.frame"}) {
        EXPECT_FALSE(screen.enabled(name)) << name;
    }
    EXPECT_FALSE(screen.shows("timeline.axis"));
}

}  // namespace
}  // namespace dollytrack::ui::timeline_panel_test
