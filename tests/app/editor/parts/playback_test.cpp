#include "app/editor/timeline/playback.h"

#include "app/editor/timeline/step_playback.h"

#include <gtest/gtest.h>

namespace dollytrack::editor::playback_test {
namespace {

TEST(Playback, LosesNoTimeBetweenFramesAndStopsAtTheEnd) {
    Playback playback;
    playback.setFrameCount(5);
    playback.toggle();
    for (int i = 0; i < 8; ++i) playback.advance(0.25, false);  // exact in binary
    EXPECT_EQ(playback.frame(), 2);
    EXPECT_EQ(playback.untilNext(), 1.0);
    playback.advance(0.25, false);
    EXPECT_EQ(playback.untilNext(), 0.75);
    playback.advance(10.0, false);
    EXPECT_EQ(playback.frame(), 4);
    EXPECT_FALSE(playback.playing());
    playback.toggle();  // at the end it starts from the beginning
    EXPECT_EQ(playback.frame(), 0);
    playback.advance(7.0, true);
    EXPECT_EQ(playback.frame(), 2);
    EXPECT_TRUE(playback.playing());
    playback.setFrameCount(2);
    EXPECT_EQ(playback.frame(), 1);
}

TEST(StepPlayback, GoesFromStopToStop) {
    const StepPlayback::Next next = [](std::size_t taken) -> std::optional<std::size_t> {
        if (taken >= 7) return std::nullopt;
        return taken + 3;
    };
    StepPlayback steps;
    steps.toggle(next);
    steps.advance(2.5, next);
    EXPECT_EQ(steps.taken(), 6U);
    steps.advance(5.0, next);
    EXPECT_EQ(steps.taken(), 9U);
    EXPECT_FALSE(steps.playing());
    steps.toggle(next);
    EXPECT_EQ(steps.taken(), 0U);
}

}  // namespace
}  // namespace dollytrack::editor::playback_test
