#include "render/sensors/depth_noise.h"

#include "engine/camera/intrinsics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace dollytrack::render::depth_noise_test {
namespace {

/// A wall of one colour across the view; tests change single pixels.
struct Wall {
    explicit Wall(double depth_m, std::uint8_t color = 188) {  // 188: half of white's light
        CameraParams camera;
        camera.width_px = 320;
        camera.height_px = 240;
        camera.hfov_deg = 20.0;  // almost straight on
        lens = makeIntrinsics(camera);
        const std::size_t pixels = 320 * 240;
        depth.assign(pixels, static_cast<float>(depth_m));
        normals.assign(pixels, {0, 0, -1});
        albedo.assign(3 * pixels, color);
    }
    [[nodiscard]] std::vector<float> seen(DepthNoise model, double strength = 1.0, int seed = 1,
                                          int frame = 0) const {
        SensorParams params;
        params.depth_noise = model;
        params.depth_noise_strength = strength;
        params.sensor_seed = seed;
        return noisyDepth(params,
                          {frame, lens, Eigen::Quaterniond::Identity(), depth, normals, albedo});
    }
    [[nodiscard]] float& at(int x, int y) {
        return depth[static_cast<std::size_t>(y) * 320 + static_cast<std::size_t>(x)];
    }
    Intrinsics lens;
    std::vector<float> depth;
    std::vector<Eigen::Vector3f> normals;
    std::vector<std::uint8_t> albedo;
};

struct Spread {
    double bias = 0.0;
    double deviation = 0.0;
    int holes = 0;
};

Spread spreadOf(const std::vector<float>& seen, double exact) {
    Spread spread;
    double squares = 0.0;
    int count = 0;
    for (const float metres : seen) {
        if (metres == 0.0F) {
            ++spread.holes;
            continue;
        }
        spread.bias += metres - exact;
        squares += (metres - exact) * (metres - exact);
        ++count;
    }
    spread.bias /= count;
    spread.deviation = std::sqrt(squares / count - spread.bias * spread.bias);
    return spread;
}

TEST(DepthNoise, TimeOfFlightHasThePublishedDeviation) {
    // 0.5 mm, plus 1 mm per metre beyond half a metre.
    for (const auto& [metres, millimetres] :
         {std::pair(0.6, 0.6), {1.0, 1.0}, {2.0, 2.0}, {3.5, 3.5}, {5.0, 5.0}}) {
        const Spread found = spreadOf(Wall(metres).seen(DepthNoise::KinectAzure), metres);
        EXPECT_NEAR(1000.0 * found.deviation / millimetres, 1.0, 0.03) << metres;
        EXPECT_NEAR(found.bias, 0.0, 5 * found.deviation / std::sqrt(76'800.0));
        EXPECT_EQ(found.holes, 0);
        EXPECT_LT(found.deviation, 0.017) << "the bound that Toelgyessy et al. confirm";
    }
    EXPECT_EQ(Wall(2.0).seen(DepthNoise::None), Wall(2.0).depth);
    EXPECT_NEAR(spreadOf(Wall(2.0).seen(DepthNoise::KinectAzure, 3.0), 2.0).deviation, 0.006,
                0.0002);
}

TEST(DepthNoise, DarkAndGrazingSurfacesAreNoisierAndThenHoles) {
    const double straight = spreadOf(Wall(2.0).seen(DepthNoise::KinectAzure), 2.0).deviation;
    // This value encodes about an eighth of white's light: a fourth of the other.
    const double dark = spreadOf(Wall(2.0, 99).seen(DepthNoise::KinectAzure), 2.0).deviation;
    EXPECT_NEAR(dark / straight, 2.0, 0.1);
    Wall grazing(2.0);
    grazing.normals.assign(grazing.normals.size(), Eigen::Vector3f(0, 0.9682F, -0.25F));
    const double aslant = spreadOf(grazing.seen(DepthNoise::KinectAzure), 2.0).deviation;
    EXPECT_NEAR(aslant / straight, 2.0, 0.2);
    EXPECT_EQ(spreadOf(Wall(5.0, 20).seen(DepthNoise::KinectAzure), 5.0).holes, 320 * 240);
    EXPECT_EQ(spreadOf(Wall(1.0, 20).seen(DepthNoise::KinectAzure), 1.0).holes, 0);
    EXPECT_EQ(spreadOf(Wall(5.0, 20).seen(DepthNoise::Redwood), 5.0).holes, 0);
}

TEST(DepthNoise, HolesAreAtEdgesAndOutOfReachAndNowhereElse) {
    for (const DepthNoise model : {DepthNoise::KinectAzure, DepthNoise::Redwood}) {
        Wall wall(2.0);
        for (int y = 60; y < 180; ++y) {
            for (int x = 100; x < 200; ++x) wall.at(x, y) = 1.5F;
        }
        const std::vector<float> seen = wall.seen(model);
        for (int y = 0; y < 240; ++y) {
            for (int x = 0; x < 320; ++x) {
                const bool inside = x >= 101 && x < 199 && y >= 61 && y < 179;
                const bool outside = x < 99 || x > 200 || y < 59 || y > 180;
                const bool hole = seen[static_cast<std::size_t>(y) * 320 + x] == 0.0F;
                EXPECT_EQ(hole, !inside && !outside) << x << " " << y;
            }
        }
        EXPECT_EQ(spreadOf(Wall(0.3).seen(model), 0.3).holes, 320 * 240) << "too near";
        EXPECT_EQ(spreadOf(Wall(12.0).seen(model), 12.0).holes, 320 * 240) << "too far";
    }
}

// The depth of a floor that runs away from the camera changes by decimetres from row to row, but is
// not an edge.
TEST(DepthNoise, ASteepPlaneIsNoEdge) {
    Wall floor(1.0);
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 320; ++x) floor.at(x, y) = 300.0F / static_cast<float>(65 + y);
    }
    EXPECT_GT(floor.at(0, 0) - floor.at(0, 2), 0.12F);
    EXPECT_EQ(spreadOf(floor.seen(DepthNoise::Redwood), 1.0).holes, 0);
    floor.at(50, 100) += 0.5F;
    EXPECT_GT(spreadOf(floor.seen(DepthNoise::Redwood), 1.0).holes, 4);
}

TEST(DepthNoise, StructuredLightComesInStepsOfDisparity) {
    for (const double metres : {1.0, 2.0, 4.0}) {
        const std::vector<float> seen = Wall(metres).seen(DepthNoise::Redwood);
        for (const float one : seen) {
            const double steps = 8.0 * 35.130 / one;
            ASSERT_NEAR(steps, std::round(steps), 1e-4 * steps);
        }
        const double step_m = metres * metres / 35.130;
        EXPECT_NEAR(depthDeviation(DepthNoise::Redwood, metres),
                    step_m * std::hypot(0.027778, 0.125 / std::sqrt(12.0)), 1e-6);
    }
    // Averages over walls at many depths, which cover all positions between two steps: both
    // variances add up.
    const auto errorAround = [](double metres) {
        double squares = 0.0;
        for (int i = 0; i < 40; ++i) {
            const double exact = metres * (1.0 + 0.0021 * i);
            const Spread found = spreadOf(Wall(exact).seen(DepthNoise::Redwood), exact);
            squares += (found.bias * found.bias + found.deviation * found.deviation) / 40.0 /
                       std::pow(depthDeviation(DepthNoise::Redwood, exact), 2);
        }
        return std::sqrt(squares);
    };
    EXPECT_NEAR(errorAround(1.0), 1.0, 0.1);
    EXPECT_NEAR(errorAround(3.0), 1.0, 0.1);
}

// The published program first jitters the position and then takes the even pixel at or before it.
TEST(DepthNoise, StructuredLightJittersBeforeItTakesEverySecondPixel) {
    // Blocks of 2 x 2 px whose depths repeat every three blocks; odd pixels have other depths,
    // which must never appear. Noise is far smaller than the steps between all depths.
    const std::array<float, 3> depths = {1.00F, 1.03F, 1.06F};
    Wall wall(1.0);
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 320; ++x) {
            const bool even = x % 2 == 0 && y % 2 == 0;
            wall.at(x, y) = depths[x / 2 % 3] + (even ? 0.0F : 0.015F);
        }
    }
    const std::vector<float> seen = wall.seen(DepthNoise::Redwood);
    std::array<std::array<int, 3>, 2> from = {};  // by even or odd x: previous block, own, next
    for (int y = 0; y < 240; ++y) {
        for (int x = 2; x < 318; ++x) {
            const double one = seen[static_cast<std::size_t>(y) * 320 + x];
            int block = -1;
            for (int i = 0; i < 3; ++i) {
                if (std::abs(one - depths[i]) < 0.007) block = i;
            }
            ASSERT_GE(block, 0) << one << " at " << x << " " << y << " is no even pixel's";
            ++from[x % 2][(block - x / 2 % 3 + 4) % 3];
        }
    }
    // Half a pixel is two standard deviations: 2.275 % of all jitter further to one side.
    const double all = 240.0 * 158.0;
    EXPECT_NEAR(from[0][0] / all, 0.02275, 0.004) << "even ones leave their block to the left";
    EXPECT_EQ(from[0][2], 0);
    EXPECT_NEAR(from[1][2] / all, 0.02275, 0.004) << "odd ones to the right";
    EXPECT_EQ(from[1][0], 0);
}

TEST(DepthNoise, DependsOnSeedAndFrame) {
    const Wall wall(2.0);
    EXPECT_EQ(wall.seen(DepthNoise::KinectAzure), wall.seen(DepthNoise::KinectAzure));
    EXPECT_NE(wall.seen(DepthNoise::KinectAzure, 1, 2), wall.seen(DepthNoise::KinectAzure));
    EXPECT_NE(wall.seen(DepthNoise::KinectAzure, 1, 1, 1), wall.seen(DepthNoise::KinectAzure));
}

}  // namespace
}  // namespace dollytrack::render::depth_noise_test
