#include "planning/viewpoints/key_frames.h"

#include "engine/core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace dollytrack::planning::key_frames_test {
namespace {

PositionPoint seeing(const std::vector<int>& well, const std::vector<int>& captured) {
    PositionPoint point;
    point.well_captured = well;
    point.captured = captured;
    return point;
}

std::vector<PositionPoint> randomPoints(Random& random) {
    std::vector<PositionPoint> points(1 + random.below(25));
    for (PositionPoint& point : points) {
        for (int id = 1; id <= 30; ++id) {
            if (random.below(6) != 0) continue;
            point.captured.push_back(id);
            if (random.below(2) == 0) point.well_captured.push_back(id);
        }
    }
    return points;
}

struct Covered {
    std::set<int> well;
    std::set<int> captured;
    bool operator==(const Covered&) const = default;

    void add(const PositionPoint& point) {
        well.insert(point.well_captured.begin(), point.well_captured.end());
        captured.insert(point.captured.begin(), point.captured.end());
    }
};

}  // namespace

TEST(ChooseKeyFrames, CoversAllThatAllCover) {
    Random random(9);
    for (int round = 0; round < 200; ++round) {
        const std::vector<PositionPoint> points = randomPoints(random);
        const std::vector<int> chosen = chooseKeyFrames(points);
        EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()).size(), chosen.size());
        Covered all;
        for (const PositionPoint& point : points) all.add(point);
        Covered by_chosen;
        for (const int i : chosen) {
            const Covered before = by_chosen;
            by_chosen.add(points.at(i));
            EXPECT_NE(by_chosen, before) << "a key frame that adds nothing";
        }
        EXPECT_EQ(by_chosen, all) << "round " << round;
        EXPECT_EQ(chooseKeyFrames(points), chosen);
    }
}

TEST(ChooseKeyFrames, WellCapturedCountsFirst) {
    const std::vector<PositionPoint> points = {
        seeing({}, {1, 2, 3, 4, 5, 6}),
        seeing({7}, {7}),
        seeing({1, 2}, {1, 2}),
    };
    EXPECT_EQ(chooseKeyFrames(points), (std::vector<int>{2, 1, 0}));
}

TEST(ChooseKeyFrames, AmongEquallyWellTheOneThatCapturesMore) {
    const std::vector<PositionPoint> points = {seeing({1}, {1}), seeing({1}, {1, 2})};
    EXPECT_EQ(chooseKeyFrames(points), std::vector<int>{1});
}

TEST(ChooseKeyFrames, NothingFromNothing) {
    EXPECT_TRUE(chooseKeyFrames({}).empty());
    EXPECT_TRUE(chooseKeyFrames({seeing({}, {})}).empty());
}

}  // namespace dollytrack::planning::key_frames_test
