#include "planning/smoothing/smooth_path.h"

#include "planning/collision/swept_sphere.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/view_estimator.h"
#include "tests/planning/support/map_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace dollytrack::planning::smooth_path_test {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.1;
const Vector3d kCorner(3, 1, 1.2);

struct World {
    Scene scene;
    RayCaster rays;
    FreeSpace free_space;
    ViewEstimator views;
    SweptSphere sphere;

    explicit World(Scene made)
        : scene(std::move(made)),
          rays(scene),
          free_space(test_support::map(scene, 0.05, kRadius)),
          views(scene, rays, {}),
          sphere(rays, free_space, kRadius) {}

    [[nodiscard]] SmoothPath smooth(const std::vector<Vector3d>& places) const {
        CameraPath path;
        for (const Vector3d& place : places) path.vertices.push_back({place, -1});
        auto smooth = smoothPath(path, {}, {}, {views, free_space, sphere}, SmoothingParams{}, {});
        EXPECT_TRUE(smooth.has_value());
        return smooth.value_or(SmoothPath{});
    }
};

test::SceneBuilder emptyRoom() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {5, 5, 2.6});
    return builder;
}

/// Calls `visit` every 2 mm along the path, computed from the definition of its pieces.
template <class Visit>
void walk(const SmoothPath& path, Visit&& visit) {
    for (const SmoothPath::Piece& piece : path.pieces) {
        const int steps = static_cast<int>(((piece.control - piece.start).norm() +
                                            (piece.end - piece.control).norm()) /
                                           0.002) +
                          1;
        for (int i = 0; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            const Vector3d a = piece.start + t * (piece.control - piece.start);
            const Vector3d b = piece.control + t * (piece.end - piece.control);
            visit(Vector3d(a + t * (b - a)));
        }
    }
}

double nearestTo(const SmoothPath& path, const Vector3d& place) {
    double least = std::numeric_limits<double>::infinity();
    walk(path, [&](const Vector3d& p) { least = std::min(least, (p - place).norm()); });
    return least;
}

}  // namespace

// A quadratic Bezier curve passes a right-angled corner at a distance of sqrt(2)/4 of the set-back.
TEST(SmoothPath, CutsASquareCornerBySixteenCentimetres) {
    const World world(emptyRoom().build());
    const SmoothPath path = world.smooth({{1, 1, 1.2}, kCorner, {3, 3, 1.2}});
    ASSERT_EQ(path.corners.size(), 1U);
    EXPECT_NEAR(path.corners[0].set_back_m, 0.45, 1e-9);
    EXPECT_FALSE(path.corners[0].shortened);
    EXPECT_NEAR(nearestTo(path, kCorner), 0.159, 0.002);
    EXPECT_NEAR(nearestTo(path, {2.55, 1, 1.2}), 0.0, 0.002);
    EXPECT_NEAR(nearestTo(path, {3, 1.45, 1.2}), 0.0, 0.002);
    EXPECT_EQ(path.collisions, 0);

    double walked = 0.0;
    Vector3d last(1, 1, 1.2);
    walk(path, [&](const Vector3d& p) {
        EXPECT_LT((p - last).norm(), 0.003);  // no gap between pieces
        walked += (p - last).norm();
        last = p;
    });
    EXPECT_LT((last - Vector3d(3, 3, 1.2)).norm(), 1e-9);
    EXPECT_NEAR(path.length_m, walked, 0.002);
}

TEST(SmoothPath, TakesAtMostHalfOfAShortLeg) {
    const World world(emptyRoom().build());
    const SmoothPath path = world.smooth({{1, 1, 1.2}, kCorner, {3, 1.5, 1.2}});
    ASSERT_EQ(path.corners.size(), 1U);
    EXPECT_NEAR(path.corners[0].set_back_m, 0.25, 1e-9);
    EXPECT_TRUE(path.corners[0].shortened);
}

// The post is 17 cm away from both legs, but blocks the full curve.
TEST(SmoothPath, ShrinksNextToAnObstacleAndStaysFree) {
    test::SceneBuilder builder = emptyRoom();
    builder.object("post").box(kCorner + Vector3d(-0.22, 0.22, -0.3), {0.1, 0.1, 1.8});
    const World world(builder.build());
    const SmoothPath path = world.smooth({{1, 1, 1.2}, kCorner, {3, 3, 1.2}});
    ASSERT_EQ(path.corners.size(), 1U);
    EXPECT_GT(path.corners[0].set_back_m, 0.0);
    EXPECT_LT(path.corners[0].set_back_m, 0.44);
    EXPECT_TRUE(path.corners[0].shortened);
    EXPECT_EQ(path.collisions, 0);
    double clearance = std::numeric_limits<double>::infinity();
    walk(path, [&](const Vector3d& p) {
        clearance = std::min(clearance, world.rays.closest(p).distance);
    });
    EXPECT_GE(clearance, kRadius);
    EXPECT_NEAR(clearance, path.min_clearance_m, 0.01);
}

TEST(SmoothPath, StopsAndTurnsAtAReversal) {
    const World world(emptyRoom().build());
    for (const double aside : {0.0, 0.1}) {
        const SmoothPath path = world.smooth({{1, 1, 1.2}, kCorner, {1, 1 + aside, 1.2}});
        ASSERT_EQ(path.corners.size(), 1U);
        EXPECT_EQ(path.corners[0].set_back_m, 0.0);
        EXPECT_LT(nearestTo(path, kCorner), 1e-9);
        for (const SmoothPath::Piece& piece : path.pieces) EXPECT_FALSE(piece.curved);
    }
}

TEST(SmoothPath, KeepsAPathWithoutCorners) {
    const World world(emptyRoom().build());
    const SmoothPath path = world.smooth({{1, 1, 1.2}, {3, 1, 1.2}});
    EXPECT_TRUE(path.corners.empty());
    EXPECT_NEAR(path.length_m, 2.0, 1e-9);
    EXPECT_NEAR(world.smooth({{1, 1, 1.2}}).length_m, 0.0, 1e-12);
}

}  // namespace dollytrack::planning::smooth_path_test
