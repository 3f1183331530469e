#include "planning/gaze/corner_panorama.h"

#include "engine/plan/frame_quality.h"
#include "planning/gaze/image_corners.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <numbers>

namespace dollytrack::planning::corner_panorama_test {
namespace {

/// A texture of squares, each `square` texels wide; a grey one for 0.
Texture squares(int size, int square) {
    Texture texture{"squares", size, size, {}};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const bool white = square > 0 && (x / square + y / square) % 2 == 0;
            const std::uint8_t value = square == 0 ? 128 : white ? 255 : 0;
            texture.rgba.insert(texture.rgba.end(), {value, value, value, 255});
        }
    }
    return texture;
}

Scene texturedWith(Texture texture) {
    Scene scene;
    scene.textures.push_back(std::move(texture));
    scene.materials.emplace_back().texture = 0;
    return scene;
}

/// A room with shelves of many small boxes along the wall at x = 0.
Scene roomWithShelves() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 5, 2.6});
    builder.object("box").box({5.5, 0.4, 0.2}, {0.3, 0.3, 0.4});
    for (int row = 0; row < 4; ++row) {
        for (int i = 0; i < 12; ++i) {
            test::SceneBuilder::Look look;
            look.color =
                i % 2 == 0 ? Eigen::Vector3f(0.9F, 0.9F, 0.8F) : Eigen::Vector3f(0.1F, 0.05F, 0.1F);
            builder.object("book", look)
                .box({0.15, 0.5 + 0.35 * i, 0.4 + 0.5 * row}, {0.3, 0.2, 0.3});
        }
    }
    return builder.build();
}

/// What estimates of corners in that room need.
struct ShelfRoom {
    Scene scene = roomWithShelves();
    RayCaster rays{scene};
    ViewEstimator views{scene, rays, CameraParams{}};
    TextureCorners textures{scene};
};

}  // namespace

// A board of squares has one corner per square.
TEST(TextureCorners, CountTheCornersOfSquares) {
    const TextureCorners corners(texturedWith(squares(512, 16)));
    const double expected = 1.0 / (16.0 * 16.0);
    for (const Eigen::Vector2f& uv : {Eigen::Vector2f(0.3F, 0.3F), Eigen::Vector2f(-3.4F, 7.7F)}) {
        EXPECT_NEAR(corners.perPixel(0, uv, 1.0), expected, 0.25 * expected);
        // Drawn at half the size there are four times as many per pixel; at twice the size, a
        // quarter.
        EXPECT_NEAR(corners.perPixel(0, uv, 2.0), 4.0 * expected, expected);
        EXPECT_NEAR(corners.perPixel(0, uv, 0.5), 0.25 * expected, 0.07 * expected);
    }
    EXPECT_NEAR(corners.brightness(0), 0.5, 0.01);
    EXPECT_EQ(corners.brightness(-1), 1.0);
}

TEST(TextureCorners, FindNoneOnGreyOrWithoutATexture) {
    const TextureCorners corners(texturedWith(squares(64, 0)));
    EXPECT_EQ(corners.perPixel(0, {0.5F, 0.5F}, 1.0), 0.0);
    EXPECT_EQ(corners.perPixel(-1, {0.5F, 0.5F}, 1.0), 0.0);
    EXPECT_EQ(TextureCorners(texturedWith(Texture{"missing", 0, 0, {}})).perPixel(0, {0, 0}, 1.0),
              0.0);
    Texture narrow = squares(64, 0);  // as many texels, in one row
    narrow.width = 4096;
    narrow.height = 1;
    EXPECT_EQ(TextureCorners(texturedWith(narrow)).perPixel(0, {0.5F, 0.5F}, 1.0), 0.0);
    EXPECT_EQ(corners.perPixel(0, {std::nanf(""), 0.5F}, 1.0), 0.0);
}

TEST(CornerPanorama, TellsShelvesFromABareWall) {
    const ShelfRoom room;
    CornerPanoramas panoramas(room.views);
    const auto panorama = panoramas.at({2.5, 2.5, 1.3});
    const double shelves = panorama->corners({-1, 0, 0});
    EXPECT_GT(shelves, 350.0);
    EXPECT_LT(panorama->corners({0, 1, 0.1}), 0.1 * shelves);
    EXPECT_LT(panorama->corners({0, -1, 0.1}), 0.1 * shelves);
    EXPECT_EQ(panoramas.at({2.5, 2.5, 1.3}), panorama);
    EXPECT_NE(panoramas.at({2.5, 2.5, 1.4}), panorama);
}

// Rays near the direction suffice, also where the image reaches the end of the grid.
TEST(CornerPanorama, CountsTheSameWithRaysOfOneView) {
    const ShelfRoom room;
    const Eigen::Vector3d position(1.5, 2.5, 1.3);
    const CornerPanorama all(room.views, room.textures, position);
    int counted = 0;
    for (const Eigen::Vector3d& direction :
         {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(-1, 0.7, -0.4), Eigen::Vector3d(0.3, -1, 0.9),
          Eigen::Vector3d(-0.3, 0.1, -1)}) {
        const CornerPanorama one(room.views, room.textures, position, direction);
        const double expected = all.corners(direction);
        EXPECT_NEAR(one.corners(direction), expected, 0.01 * expected) << direction.transpose();
        counted += all.corners(direction) > 50.0;
    }
    EXPECT_GE(counted, 2);
}

TEST(ImageCorners, WeighObjectsByTheBestOfTheirViews) {
    const ShelfRoom room;
    std::vector<PositionPoint> points(2);
    points[0].pose = {{2.5, 2.5, 1.3}, lookAlong({-1, 0, 0})};   // the shelves
    points[1].pose = {{2.5, 2.5, 1.3}, lookAlong({0, 1, 0.1})};  // a bare wall
    points[0].captured = {1, 2};
    points[1].captured = {2, 3};
    std::vector<double> weights;
    weighByCorners(room.views, room.textures, points, weights, JobContext{});
    ASSERT_EQ(weights.size(), room.scene.objects.size());
    EXPECT_EQ(weights[0], 1.0);
    EXPECT_EQ(weights[1], 1.0);
    EXPECT_LT(weights[2], 0.2);
    EXPECT_EQ(weights[3], 1.0);  // no view of it
    std::vector<double> given(room.scene.objects.size(), 3.0);
    weighByCorners(room.views, room.textures, points, given, JobContext{});
    EXPECT_EQ(given[0], 3.0);
    EXPECT_EQ(given[2], 3.0 * weights[2]);
}

TEST(ImageCorners, FindPointsWithBareViewsOnBothSides) {
    std::vector<PositionPoint> points(5);
    points[3].pin = 0;
    // The points found for these paths. Each number is a frame: -1 with few corners, -2 with many,
    // from 0 a key frame (with many) at that position point.
    const auto among = [&](const std::vector<std::vector<int>>& paths) {
        Trajectory trajectory;
        std::vector<double> corners;
        for (std::size_t path = 0; path < paths.size(); ++path) {
            for (const int each : paths[path]) {
                TrajectoryFrame& frame = trajectory.frames.emplace_back();
                frame.path = static_cast<int>(path);
                frame.position_point = std::max(each, -1);
                corners.push_back(each == -1 ? 0.0 : kTrackableCorners);
            }
        }
        return pointsAmongBareViews(trajectory, corners, points);
    };
    using Points = std::vector<int>;
    EXPECT_EQ(among({{0, -2, -1, 1, -1, 2, -2, 4}}), Points{1});
    EXPECT_EQ(among({{0, -2, -1, 1, -1, -1, 2, -1, 4}}), (Points{1, 2}));
    EXPECT_EQ(among({{0, -1, 1, -2, 2, -1, -1, 4, -2}}), Points{2});  // the more frames
    EXPECT_EQ(among({{0, -1, 3, -1, 1}}), Points{0});                 // the pinned one stays
    EXPECT_EQ(among({{0, -1, 1}, {-1, 2, -2}}), Points{0});           // a jump between paths
    EXPECT_EQ(among({{0, -2, 1}, {2, -2}}), Points{});
    EXPECT_EQ(among({{-1, -1}}), Points{});
    EXPECT_EQ(among({}), Points{});
}

TEST(ImageCorners, LongestRunEndsAtBareViewsAndPaths) {
    Trajectory trajectory;
    trajectory.frames.resize(9);
    std::vector<double> corners(9, kTrackableCorners);
    EXPECT_EQ(longestTrackableRun(trajectory, corners), 9U);
    corners[3] = kTrackableCorners - 1;
    EXPECT_EQ(longestTrackableRun(trajectory, corners), 5U);
    for (std::size_t i = 6; i < 9; ++i) trajectory.frames[i].path = 1;
    EXPECT_EQ(longestTrackableRun(trajectory, corners), 3U);
    EXPECT_EQ(longestTrackableRun(trajectory, std::vector<double>(9, 0.0)), 0U);
    EXPECT_EQ(longestTrackableRun({}, {}), 0U);
}

TEST(ImageCorners, CountLittleWhereTheImageFiveFramesEarlierShowsNone) {
    const ShelfRoom room;
    Trajectory trajectory;
    for (int i = 0; i < 11; ++i) {
        TrajectoryFrame& frame = trajectory.frames.emplace_back();
        const Eigen::Vector3d shelves(-1, 0, 0), wall(0, 1, 0.1);
        frame.pose = {{2.5, 2.5, 1.3}, lookAlong(i < 5 ? wall : shelves)};
    }
    const auto turned = estimateImageCorners(room.views, room.textures, trajectory, {});
    ASSERT_TRUE(turned);
    EXPECT_LT((*turned)[5], 10.0);
    EXPECT_LT((*turned)[9], 10.0);
    EXPECT_GT((*turned)[10], 350.0);
    for (std::size_t i = 5; i < 11; ++i) trajectory.frames[i].path = 1;
    const auto two_paths = estimateImageCorners(room.views, room.textures, trajectory, {});
    ASSERT_TRUE(two_paths);
    EXPECT_EQ((*two_paths)[5], (*turned)[10]);
    // A step back: the earlier image shows the middle of the shelves only.
    trajectory.frames[5].pose.position.x() = 0.9;
    const auto moved = estimateImageCorners(room.views, room.textures, trajectory, {});
    ASSERT_TRUE(moved);
    EXPECT_LT((*moved)[10], 0.9 * (*turned)[10]);
    EXPECT_GT((*moved)[10], 10.0);
}

TEST(ImageCorners, RateIsTheShareOfFramesThatShowTheShelves) {
    const ShelfRoom room;
    Trajectory trajectory;
    for (const Eigen::Vector3d& direction :
         {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0.1), Eigen::Vector3d(-1, 0.1, 0),
          Eigen::Vector3d(0, -1, 0.1)}) {
        TrajectoryFrame& frame = trajectory.frames.emplace_back();
        frame.pose = {{2.5, 2.5, 1.3}, lookAlong(direction)};
    }
    // A camera that lies on its side sees more of the wall above and below the shelves.
    TrajectoryFrame& turned = trajectory.frames.emplace_back(trajectory.frames[0]);
    turned.path = 1;
    turned.pose.rotation =
        turned.pose.rotation *
        Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()));
    auto corners = estimateImageCorners(room.views, room.textures, trajectory, {});
    ASSERT_TRUE(corners);
    EXPECT_GT((*corners)[0], 350.0);
    EXPECT_LT(corners->back(), 0.95 * corners->front());
    corners->pop_back();
    EXPECT_EQ(trackableRate(*corners), 0.5);
    EXPECT_EQ(trackableRate({}), std::nullopt);
    EXPECT_EQ(trackableRate({kTrackableCorners, kTrackableCorners - 1}), 0.5);
    EXPECT_EQ(trackableRate({0.0, 0.0, 0.0, kTrackableCorners, kTrackableCorners}), 0.4);
}

}  // namespace dollytrack::planning::corner_panorama_test
