#include "engine/plan/image_score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dollytrack::image_score_test {
namespace {

using Boxes = std::vector<Eigen::AlignedBox2d>;

Eigen::AlignedBox2d box(double left, double top, double right, double bottom) {
    return {Eigen::Vector2d(left, top), Eigen::Vector2d(right, bottom)};
}

/// Frames on these paths.
Trajectory framesOn(const std::vector<int>& paths) {
    Trajectory trajectory;
    for (const int path : paths) {
        TrajectoryFrame frame;
        frame.path = path;
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

TEST(ImageScore, SeparationOfTwoBoxesIsTheirDistanceByTheirDiagonal) {
    // Centres 30 apart; the box around both is 40 x 30, its diagonal 50.
    const Boxes apart = {box(0, 0, 10, 30), box(30, 0, 40, 30)};
    EXPECT_NEAR(boxSeparation(apart, false), 30.0 / 50.0, 1e-12);
    EXPECT_NEAR(boxSeparation(apart, true), 0.36, 1e-12);
}

TEST(ImageScore, SeparationLosesTheOverlap) {
    // 10 x 10 each, half of each shared: 50 / 150; centres 5 apart; around both 15 x 10.
    const Boxes overlapping = {box(0, 0, 10, 10), box(5, 0, 15, 10)};
    EXPECT_NEAR(boxSeparation(overlapping, false), 5.0 / std::hypot(15.0, 10.0) - 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(boxSeparation({box(0, 0, 8, 8), box(0, 0, 8, 8)}, false), -1.0, 1e-12);
}

TEST(ImageScore, SeparationIsTheMeanOverAllPairs) {
    const Boxes three = {box(0, 0, 10, 30), box(30, 0, 40, 30), box(0, 0, 10, 30)};
    EXPECT_NEAR(boxSeparation(three, false), (0.6 + 0.6 - 1.0) / 3.0, 1e-12);
    EXPECT_EQ(boxSeparation({box(3, 3, 4, 4)}, false), 1.0);
    EXPECT_EQ(boxSeparation({}, false), 0.0);
}

TEST(ImageScore, ContinuityComparesAFrameWithThoseBeforeItOnItsPath) {
    const Trajectory trajectory = framesOn({0, 0, 0, 0, 1, 1});
    std::vector<Boxes> boxes;
    for (const std::size_t count : {4U, 2U, 0U, 6U, 3U, 3U}) {
        boxes.emplace_back(count, box(0, 0, 10, 10));
    }
    ScoreWeights weights;
    weights.separation = 0.0;
    weights.window = 2;
    const std::vector<double> scores = imageScores(trajectory, boxes, weights);
    // 2/4; nothing; (none before: 1, 6/2) / 2; a new path; 3/3.
    const std::vector<double> expected = {1.0, 0.5, 0.0, 2.0, 1.0, 1.0};
    ASSERT_EQ(scores.size(), expected.size());
    for (std::size_t i = 0; i < scores.size(); ++i) EXPECT_NEAR(scores[i], expected[i], 1e-12) << i;
}

TEST(ImageScore, IsTheWeightedSumAndZeroWithoutObjects) {
    const Trajectory trajectory = framesOn({0, 0});
    const std::vector<Boxes> boxes = {{box(0, 0, 10, 30), box(30, 0, 40, 30)}, {}};
    ScoreWeights weights;
    weights.separation = 2.0;
    weights.continuity = 3.0;
    const std::vector<double> scores = imageScores(trajectory, boxes, weights);
    EXPECT_NEAR(scores[0], 2.0 * 0.6 + 3.0, 1e-12);
    EXPECT_EQ(scores[1], 0.0);
}

}  // namespace
}  // namespace dollytrack::image_score_test
