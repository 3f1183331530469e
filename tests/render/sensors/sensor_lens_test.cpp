#include "render/sensors/sensor_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace dollytrack::render::sensor_lens_test {
namespace {

CameraParams wideCamera() {
    CameraParams camera;
    camera.width_px = 320;
    camera.height_px = 240;
    camera.hfov_deg = 80.0;
    return camera;
}

SensorParams bent(double k1, double k2, double p1 = 0.0, double p2 = 0.0, double k3 = 0.0) {
    SensorParams params = sensorPreset(SensorPreset::Ideal);
    params.k1 = k1;
    params.k2 = k2;
    params.p1 = p1;
    params.p2 = p2;
    params.k3 = k3;
    return params;
}

const std::vector<SensorParams>& lenses() {
    static const std::vector<SensorParams> all = {bent(-0.26, 0.09, 0.0, 0.0, -0.015),
                                                  bent(0.1, 0.05, 0.003, -0.002),
                                                  bent(-0.1, 0.08, 0.0004, -0.0003)};
    return all;
}

// OpenCV has the same model and an independent inverse.
TEST(SensorLens, PixelsLookWhereOpenCvUndistortsThemTo) {
    const Intrinsics lens = makeIntrinsics(wideCamera());
    const cv::Matx33d matrix(lens.fx, 0, lens.cx - 0.5, 0, lens.fy, lens.cy - 0.5, 0, 0, 1);
    for (const SensorParams& params : lenses()) {
        const SensorLens sensor(wideCamera(), params);
        const std::vector<double> coefficients = {params.k1, params.k2, params.p1, params.p2,
                                                  params.k3};
        double largest = 0.0, moved = 0.0;
        for (int y = 0; y < 240; y += 7) {
            for (int x = 0; x < 320; x += 7) {
                const std::vector<cv::Point2d> at = {{double(x), double(y)}};
                std::vector<cv::Point2d> straight;
                cv::undistortPoints(at, straight, matrix, coefficients, cv::noArray(), matrix,
                                    cv::TermCriteria(cv::TermCriteria::COUNT, 200, 0));
                const Eigen::Vector2f source = sensor.sourceOf(static_cast<std::size_t>(y) * 320 +
                                                               static_cast<std::size_t>(x));
                const Eigen::Vector2d drawn_from(sensor.drawn().cx - lens.cx,
                                                 sensor.drawn().cy - lens.cy);
                const Eigen::Vector2d ours = source.cast<double>() - drawn_from;
                const Eigen::Vector2d theirs(straight[0].x + 0.5, straight[0].y + 0.5);
                largest = std::max(largest, (ours - theirs).norm());
                moved = std::max(moved, (ours - Eigen::Vector2d(x + 0.5, y + 0.5)).norm());
            }
        }
        EXPECT_LT(largest, 0.01);
        EXPECT_GT(moved, 3.0) << "without undistorting it is somewhere else";
        EXPECT_EQ(sensor.blackCount(), 0U);
    }
}

/// A pinhole image of a chessboard, in linear light.
std::vector<float> board(const Intrinsics& lens) {
    std::vector<float> light(3 * static_cast<std::size_t>(lens.width) * lens.height);
    const int kSamples = 8;
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            double sum = 0.0;
            for (int s = 0; s < kSamples * kSamples; ++s) {
                const Eigen::Vector3d ray = lens.unproject(x + (s % kSamples + 0.5) / kSamples,
                                                           y + (s / kSamples + 0.5) / kSamples);
                const auto square = [](double v) { return static_cast<int>(std::floor(8.0 * v)); };
                sum += (square(ray.x()) + square(ray.y())) % 2 == 0 ? 0.9 : 0.1;
            }
            const auto at = 3 * (static_cast<std::size_t>(y) * lens.width + x);
            for (std::size_t c = 0; c < 3; ++c) {
                light[at + c] = static_cast<float>(sum / (kSamples * kSamples));
            }
        }
    }
    return light;
}

TEST(SensorLens, CornersInItsPictureAreThePinholesOnceUndistorted) {
    const Intrinsics lens = makeIntrinsics(wideCamera());
    const cv::Matx33d matrix(lens.fx, 0, lens.cx - 0.5, 0, lens.fy, lens.cy - 0.5, 0, 0, 1);
    for (const SensorParams& params : lenses()) {
        const SensorLens sensor(wideCamera(), params);
        const std::vector<float> seen = sensor.take(board(sensor.drawn()));
        cv::Mat grey(240, 320, CV_32F);
        for (int i = 0; i < 240 * 320; ++i) {
            grey.at<float>(i / 320, i % 320) = seen[3 * static_cast<std::size_t>(i)];
        }
        // The visible corners of the pinhole's board, seen through the lens.
        const LensDistortion model = distortionOf(params);
        std::vector<cv::Point2f> corners;
        std::vector<cv::Point2d> expected;
        for (int i = -6; i <= 6; ++i) {
            for (int j = -5; j <= 5; ++j) {
                const Eigen::Vector2d straight(i / 8.0, j / 8.0);
                const Eigen::Vector2d at = model.bend(straight);
                const Eigen::Vector2d px = lens.project({at.x(), at.y(), 1.0});
                // Near the image borders undistorting magnifies the corner finder's error.
                if (px.x() < 40 || px.y() < 40 || px.x() > 280 || px.y() > 200) continue;
                corners.emplace_back(static_cast<float>(px.x() - 0.5 + 0.7),
                                     static_cast<float>(px.y() - 0.5 - 0.6));  // found again
                const Eigen::Vector2d pinhole = lens.project({straight.x(), straight.y(), 1.0});
                expected.emplace_back(pinhole.x() - 0.5, pinhole.y() - 0.5);
            }
        }
        ASSERT_GT(corners.size(), 40U);
        cv::GaussianBlur(grey, grey, {}, 1.2);  // the finder errs at edges sharper than a pixel
        cv::cornerSubPix(
            grey, corners, {4, 4}, {-1, -1},
            cv::TermCriteria(cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 100, 1e-4));
        const std::vector<double> coefficients = {params.k1, params.k2, params.p1, params.p2,
                                                  params.k3};
        std::vector<cv::Point2f> straight;
        cv::undistortPoints(corners, straight, matrix, coefficients, cv::noArray(), matrix,
                            cv::TermCriteria(cv::TermCriteria::COUNT, 100, 0));
        double largest = 0.0, untouched = 0.0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const cv::Point2d of(expected[i]);
            largest = std::max(largest, cv::norm(cv::Point2d(straight[i]) - of));
            untouched = std::max(untouched, cv::norm(cv::Point2d(corners[i]) - of));
        }
        EXPECT_LT(largest, 0.3);
        EXPECT_GT(untouched, 2.0);
    }
}

TEST(SensorLens, WithoutDistortionItShowsThePicture) {
    const SensorLens sensor(wideCamera(), sensorPreset(SensorPreset::Ideal));
    EXPECT_EQ(sensor.drawn().width, 320);
    const std::vector<float> light = board(sensor.drawn());
    EXPECT_EQ(sensor.take(light), light);
}

TEST(SensorLens, CornersDarkenByTheFourthPowerOfTheCosine) {
    SensorParams params = sensorPreset(SensorPreset::Ideal);
    params.vignetting = 1.0;
    const SensorLens full(wideCamera(), params);
    params.vignetting = 0.5;
    const SensorLens half(wideCamera(), params);
    const Intrinsics lens = full.drawn();
    for (const auto& [x, y] : {std::pair(0, 0), {160, 120}, {319, 120}, {100, 30}}) {
        const std::size_t pixel = static_cast<std::size_t>(y) * 320 + static_cast<std::size_t>(x);
        const double angle = std::atan(lens.unproject(x + 0.5, y + 0.5).head<2>().norm());
        const double expected = std::pow(std::cos(angle), 4);
        EXPECT_NEAR(full.lightShare(pixel), expected, 1e-6);
        EXPECT_NEAR(half.lightShare(pixel), 0.5 * (1.0 + expected), 1e-6);
        const std::vector<float> seen = full.take(std::vector<float>(3 * 320 * 240, 0.8F));
        EXPECT_NEAR(seen[3 * pixel], 0.8 * expected, 1e-6);
    }
    EXPECT_LT(full.lightShare(0), 0.4F);
}

TEST(SensorLens, WhatTheModelDoesNotReachIsBlackAndCounted) {
    // r (1 - r^2) has its maximum 0.385 at r = 0.577: directions beyond 0.385 appear nowhere in the
    // image.
    const SensorLens sensor(wideCamera(), bent(-1.0, 0.0));
    const Intrinsics lens = makeIntrinsics(wideCamera());
    std::size_t expected = 0;
    for (int i = 0; i < 320 * 240; ++i) {
        const Eigen::Vector3d at = lens.unproject(i % 320 + 0.5, i / 320 + 0.5);
        if (at.head<2>().norm() > 0.3849) ++expected;
    }
    EXPECT_GT(expected, 1000U);
    EXPECT_NEAR(static_cast<double>(sensor.blackCount()), static_cast<double>(expected),
                0.01 * 320 * 240);
    const Intrinsics& drawn = sensor.drawn();
    const std::vector<float> seen = sensor.take(
        std::vector<float>(3 * static_cast<std::size_t>(drawn.width) * drawn.height, 1.0F));
    EXPECT_EQ(seen.front(), 0.0F);
    EXPECT_FLOAT_EQ(seen[3 * (120 * 320 + 160)], 1.0F);
}

TEST(SensorLens, PresetsRiseToTheCornersOfTheWidestPicture) {
    for (const SensorPreset preset :
         {SensorPreset::Ideal, SensorPreset::Phone, SensorPreset::Webcam,
          SensorPreset::ActionCamera, SensorPreset::MachineVision}) {
        const SensorParams params = sensorPreset(preset);
        for (const auto& [width, height] : {std::pair(160, 120), {192, 108}, {90, 160}}) {
            CameraParams camera;
            camera.width_px = width;
            camera.height_px = height;
            for (const double fov : {60.0, 90.0, 150.0}) {
                camera.hfov_deg = fov;
                EXPECT_TRUE(validateLens(camera, params)) << static_cast<int>(preset) << " " << fov;
                EXPECT_EQ(SensorLens(camera, params).blackCount(), 0U);
                const Intrinsics lens = makeIntrinsics(camera);
                const double corner = lens.unproject(0.0, 0.0).head<2>().norm();
                double before = 0.0;
                for (double r = 0.001; r < corner; r += 0.001) {
                    const double s = r * r;
                    const double now =
                        r * (1.0 + params.k1 * s + params.k2 * s * s + params.k3 * s * s * s);
                    ASSERT_GT(now, before) << static_cast<int>(preset) << " at " << r;
                    before = now;
                }
            }
        }
    }
}

TEST(SensorLens, PresetsMoveTheCornersByTheSameShareOfWiderPictures) {
    const auto shareOf = [](const CameraParams& camera, const SensorParams& params) {
        const Eigen::Vector2d corner = makeIntrinsics(camera).unproject(0.0, 0.0).head<2>();
        return (distortionOf(params).bend(corner) - corner).norm() / corner.norm();
    };
    CameraParams usual;
    usual.hfov_deg = kPresetFov_deg;
    for (const SensorPreset preset : {SensorPreset::Phone, SensorPreset::Webcam,
                                      SensorPreset::ActionCamera, SensorPreset::MachineVision}) {
        const SensorParams params = sensorPreset(preset);
        EXPECT_EQ(fitPresetLens(usual, params), params);
        const double share = shareOf(usual, params);
        for (const double fov : {60.5, 90.0, 120.0, 150.0}) {
            CameraParams wide = usual;
            wide.hfov_deg = fov;
            const SensorParams fitted = fitPresetLens(wide, params);
            EXPECT_NEAR(shareOf(wide, fitted), share, 1e-9) << fov;
            EXPECT_GT(std::abs(shareOf(wide, params) - share), 1e-5) << "unless scaled";
            EXPECT_EQ(fitPresetLens(wide, fitted), fitted);
            EXPECT_TRUE(validateLens(wide, fitted));
            SensorParams by_hand = params;
            by_hand.k1 += 0.01;
            EXPECT_EQ(fitPresetLens(wide, by_hand), by_hand);
        }
        usual.hfov_deg = 40.0;
        EXPECT_EQ(fitPresetLens(usual, params), params);
        usual.hfov_deg = kPresetFov_deg;
    }
}

// Barrel distortion bends a straight line of the room in one direction only, out to the corner.
TEST(SensorLens, TheActionCameraIsABarrelOverTheWholePicture) {
    const auto bendsOneWay = [](const CameraParams& camera, const SensorParams& params) {
        const LensDistortion lens = distortionOf(params);
        const Eigen::Vector3d corner =
            makeIntrinsics(camera).unproject(camera.width_px, camera.height_px);
        for (const double high : {0.3, 0.6, 1.0}) {
            const double y = high * corner.y();
            const double step = corner.x() / 200.0;
            for (double x = step; x + step <= corner.x(); x += step) {
                const Eigen::Vector2d a = lens.bend({x - step, y});
                const Eigen::Vector2d b = lens.bend({x, y}) - a;
                const Eigen::Vector2d c = lens.bend({x + step, y}) - a;
                if (!(b.x() * c.y() - b.y() * c.x() < 0.0)) return false;
            }
        }
        return true;
    };
    const SensorParams params = sensorPreset(SensorPreset::ActionCamera);
    CameraParams camera;
    for (const double fov : {40.0, 60.0, 90.0, 120.0, 150.0}) {
        camera.hfov_deg = fov;
        EXPECT_TRUE(bendsOneWay(camera, fitPresetLens(camera, params))) << fov;
        EXPECT_EQ(bendsOneWay(camera, params), fov <= 60.0) << fov << " unless scaled";
    }
}

// r (1 - r^2 + 0.3 r^4) falls from 0.65 on and rises again from 1.26: a direction behind this fold
// would appear a second time.
TEST(SensorLens, WhatLiesBehindAFoldIsRefused) {
    const LensDistortion folded = {-1.0, 0.3, 0.0, 0.0, 0.0};
    const auto derivative = [](double r) { return 1.0 - 3.0 * r * r + 1.5 * std::pow(r, 4); };
    double fold = 0.0;
    while (derivative(fold) > 0.0) fold += 1e-4;
    EXPECT_TRUE(folded.risesTo(fold - 1e-3));
    EXPECT_FALSE(folded.risesTo(fold + 1e-3));
    EXPECT_FALSE(folded.risesTo(3.0)) << "where it rises again";
    const double highest = folded.bend({fold, 0.0}).x();
    for (double bent = 0.005; bent < 2.0; bent += 0.01) {
        EXPECT_EQ(folded.straighten({bent, 0.0}).has_value(), bent < highest - 1e-3) << bent;
    }
    CameraParams camera = wideCamera();
    const Status refused = validateLens(camera, bent(-1.0, 0.3));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Usage);
    EXPECT_NE(refused.error().message.find("hfov_deg"), std::string::npos);
    EXPECT_GT(SensorLens(camera, bent(-1.0, 0.3)).blackCount(), 0U);
    camera.hfov_deg = 20.0;
    EXPECT_TRUE(validateLens(camera, bent(-1.0, 0.3)));
}

TEST(SensorLens, DrawnRowsHoldWhatRowsLookAt) {
    const SensorLens sensor(wideCamera(), lenses().front());
    const auto [begin, end] = sensor.drawnRows(100.0, 110.0);
    for (int y = 100; y < 110; ++y) {
        for (int x = 0; x < 320; ++x) {
            const float at = sensor.sourceOf(static_cast<std::size_t>(y) * 320 + x).y();
            EXPECT_GE(at - 2.0F, static_cast<float>(begin));
            EXPECT_LE(at + 2.0F, static_cast<float>(end));
        }
    }
    EXPECT_LT(end - begin, 60);
}

// With an extremely short readout, samples belong to rows whose number exceeds every integer.
TEST(SensorLens, RowsFarOutsideAreNone) {
    const SensorLens sensor(wideCamera(), lenses().front());
    const auto all = sensor.drawnRows(-1e15, 1e15);
    const auto usual = sensor.drawnRows(0.0, 1e4);
    EXPECT_EQ(all, usual);
    const auto [begin, end] = sensor.drawnRows(1e15, 2e15);
    EXPECT_GE(begin, end);
}

}  // namespace
}  // namespace dollytrack::render::sensor_lens_test
