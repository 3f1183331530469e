#include "engine/document/object_track.h"

#include "engine/core/random.h"

#include <gtest/gtest.h>

namespace dollytrack::object_track_test {
namespace {

ObjectChange tracked(int id, std::vector<TrackKey> track) {
    ObjectChange change;
    change.object = {id, "thing"};
    change.track = std::move(track);
    return change;
}

/// Straight along x from 1 s to 5 s, at rest until 7 s, turning until 9 s.
const std::vector<TrackKey> kDrive = {
    {1.0, {}}, {5.0, {{2, 0, 0}, 0.0}}, {7.0, {{2, 0, 0}, 0.0}}, {9.0, {{2, 0, 0}, 1.0}}};

}  // namespace

// After going to any time, the objects' poses give this time again, also from a distant guess.
TEST(ObjectTrack, TimeIsReadFromWhereThingsStand) {
    Random random(3, 1);
    SceneEdits edits;
    edits.changes = {tracked(1, kDrive), tracked(2, {{0.0, {}}, {10.0, {{0, -1, 0}, 3.0}}})};
    for (int i = 0; i < 200; ++i) {
        const double time = random.uniform(0.0, 10.0);
        putAtTime(edits, time);
        for (const double guess : {0.0, time, 50.0}) {
            const auto found = timeOfMoves(edits, guess);
            ASSERT_TRUE(found) << time;
            EXPECT_NEAR(*found, time, 1e-5);
        }
    }
}

TEST(ObjectTrack, OfManyTimesTheNearestIsTaken) {
    SceneEdits edits;
    edits.changes = {tracked(1, kDrive)};
    putAtTime(edits, 6.0);
    EXPECT_EQ(timeOfMoves(edits, 6.5), 6.5);  // at rest
    EXPECT_EQ(timeOfMoves(edits, 2.0), 5.0);
    EXPECT_EQ(timeOfMoves(edits, 20.0), 7.0);
    putAtTime(edits, 30.0);
    EXPECT_EQ(timeOfMoves(edits, 12.0), 12.0);  // at the pose of the last key
}

TEST(ObjectTrack, ThereIsNoTimeForWhatStandsElsewhere) {
    SceneEdits edits;
    EXPECT_FALSE(timeOfMoves(edits, 1.0));
    edits.changes = {tracked(1, kDrive), tracked(2, {{0.0, {}}, {10.0, {{0, -1, 0}, 0.0}}})};
    putAtTime(edits, 3.0);
    edits.changes[0].move->offset_m.y() = 0.01;
    EXPECT_FALSE(timeOfMoves(edits, 3.0));
    putAtTime(edits, 3.0);
    edits.changes[1].move = ObjectMove{{0, -0.5, 0}, 0.0};  // at different times
    EXPECT_FALSE(timeOfMoves(edits, 3.0));
}

TEST(ObjectTrack, KeysStayInOrderAndReplaceOneAnother) {
    std::vector<TrackKey> track;
    for (const double time : {5.0, 1.0, 3.0, 1.0}) {
        const double turn = 0.25 * static_cast<double>(track.size());
        track = withKey(std::move(track), {time, {{time, 0, 0}, turn}});
    }
    ASSERT_EQ(track.size(), 3U);
    EXPECT_EQ(track[0], (TrackKey{1.0, {{1, 0, 0}, 0.75}}));  // the later of the two
    EXPECT_EQ(track[1].time_s, 3.0);
    EXPECT_EQ(track[2].time_s, 5.0);
    SceneEdits edits;
    EXPECT_FALSE(lastKeyTime(edits));
    edits.changes = {tracked(1, track), tracked(2, {})};
    EXPECT_EQ(lastKeyTime(edits), 5.0);
}

}  // namespace dollytrack::object_track_test
