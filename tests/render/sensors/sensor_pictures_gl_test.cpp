// Whole exports of a board in front of a wall; the image of its edge shows the effects of the
// sensor.
#include "render/frames/frame_file.h"
#include "render/light/tone_curve.h"
#include "render/sensors/sensor_lens.h"
#include "tests/render/dataset/dataset_fixture.h"

#include "engine/scene/srgb.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>

namespace dollytrack::render::sensor_pictures_gl_test {
namespace {

namespace fs = std::filesystem;
using dollytrack::test::SceneBuilder;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// The left half of the view is a black board at 2 m, the right a white wall at 4 m.
Scene boardAndWall() {
    SceneBuilder builder;
    builder.room({-3, -2, 0}, {3, 4, 3});
    SceneBuilder::Look black;
    black.color = {0.0F, 0.0F, 0.0F};
    builder.object("board", black).box({-1.5, 2.05, 1.5}, {3.0, 0.1, 3.0});
    return builder.build();
}

class SensorPicturesGl : public fixture::DatasetGlTest {
  protected:
    SensorPicturesGl() {
        scene_ = boardAndWall();
        rays_ = RayCaster(scene_);
    }

    /// The camera at the origin looks along +y and moves along +x.
    static Trajectory sideways(double speed_mps) {
        Trajectory trajectory;
        for (int i = 0; i < 3; ++i) {
            TrajectoryFrame frame;
            frame.time_s = 0.1 * i;
            frame.pose = lookAt({speed_mps * (frame.time_s - 0.1), 0, 1.5},
                                {speed_mps * (frame.time_s - 0.1), 1, 1.5});
            trajectory.frames.push_back(frame);
        }
        return trajectory;
    }

    static SensorParams ideal() {
        SensorParams params = sensorPreset(SensorPreset::Ideal);
        params.looks = 32;
        return params;
    }

    /// The green channel of the middle frame, as linear light.
    cv::Mat_<float> take(const SensorParams& params, const Trajectory& trajectory,
                         const char* modality = "rgb_sensor") {
        DatasetSettings settings;
        settings.folder = folder_ / "out";
        settings.overwrite = true;
        settings.modalities = {modality, "depth"};
        settings.formats = {"camera_json"};
        settings.sensor = params;
        const auto summary = exportWith(settings, trajectory);
        EXPECT_TRUE(summary) << (summary ? "" : describe(summary.error()));
        const cv::Mat picture = cv::imread(
            (settings.folder /
             frameFile(modality, 1,
                       std::string_view(modality) == "rgb_sensor" ? pictureEnding(params) : ".png"))
                .string(),
            cv::IMREAD_COLOR);
        EXPECT_FALSE(picture.empty());
        cv::Mat_<float> light(picture.size());
        for (int y = 0; y < picture.rows; ++y) {
            for (int x = 0; x < picture.cols; ++x) {
                const float shown =
                    linearFromSrgb(static_cast<float>(picture.at<cv::Vec3b>(y, x)[1]) / 255.0F);
                light(y, x) = inverseToneCurve(Eigen::Vector3f::Constant(shown)).x();
            }
        }
        return light;
    }

    struct Edge {
        double at = 0.0;     // px, where half of the light is reached
        double width = 0.0;  // px, of the slope of a straight ramp from dark to light
    };
    /// The edge in a row near the middle, computed from the moments of the change.
    static Edge edgeIn(const cv::Mat_<float>& light, int y) {
        const int reach = 30;
        const int middle = light.cols / 2;
        // Shading of the wall and steps of the image's bytes are not an edge.
        const double least = 0.04 * light(y, middle + reach);
        double sum = 0.0, first = 0.0, second = 0.0;
        for (int x = middle - reach; x < middle + reach; ++x) {
            const double change = std::max(0.0F, light(y, x + 1) - light(y, x));
            if (change < least) continue;
            sum += change;
            first += change * (x + 1);
            second += change * (x + 1) * (x + 1);
        }
        const double mean = first / sum;
        return {mean, std::sqrt(12.0 * std::max(0.0, second / sum - mean * mean))};
    }

    double fx_ = makeIntrinsics(fixture::smallCamera()).fx;
};

TEST_F(SensorPicturesGl, AnIdealCameraTakesTheCleanPicture) {
    const cv::Mat_<float> sensor = take(ideal(), sideways(1.0));
    const cv::Mat_<float> clean = take(ideal(), sideways(1.0), "rgb");
    // Samples are distributed differently over the pixel: only edges may differ.
    int differ = 0;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const float a = sensor(i / kWidth, i % kWidth), b = clean(i / kWidth, i % kWidth);
        if (std::abs(a - b) > 0.04F * (1.0F + b)) ++differ;
    }
    EXPECT_LT(differ, kWidth * kHeight / 50);
    EXPECT_NEAR(edgeIn(sensor, 60).at, edgeIn(clean, 60).at, 0.1);
}

TEST_F(SensorPicturesGl, AnEdgeIsBlurredByItsSpeedTimesTheShutter) {
    // At 1.5 m/s the board, 2 m away, moves in the image at 0.75 focal lengths per second.
    const double sharp = edgeIn(take(ideal(), sideways(1.5)), 60).width;
    EXPECT_LT(sharp, 1.5);
    for (const double shutter : {0.05, 0.09}) {
        SensorParams params = ideal();
        params.shutter_s = shutter;
        const Edge edge = edgeIn(take(params, sideways(1.5)), 60);
        const double expected = 1.5 / 2.0 * fx_ * shutter;
        EXPECT_NEAR(edge.width, std::hypot(expected, sharp), 0.5) << shutter;
        EXPECT_GT(expected, 4.0);
        EXPECT_NEAR(edge.at, kWidth / 2.0, 0.6) << "the frame's time is the middle";
        const double still = edgeIn(take(params, sideways(0.0)), 60).width;
        EXPECT_LT(still, 1.5) << "nothing moves";
    }
}

TEST_F(SensorPicturesGl, ARollingShutterLeansTheEdge) {
    // A row has few samples, and the edge moves in steps with them: this many rows move it by a
    // pixel.
    const auto edgeAround = [](const cv::Mat_<float>& light, int y) {
        double sum = 0.0;
        for (int row = y - 7; row <= y + 7; ++row) sum += edgeIn(light, row).at / 15.0;
        return sum;
    };
    const auto leanOf = [&](const cv::Mat_<float>& light) {
        return edgeAround(light, 110) - edgeAround(light, 10);
    };
    SensorParams params = ideal();
    EXPECT_NEAR(leanOf(take(params, sideways(1.5))), 0.0, 0.1);
    params.readout_s = 0.08;
    // From one side the board's front edge at 2 m is visible, from the other the back edge.
    const double expected =
        -1.5 * 0.5 * (1.0 / 2.0 + 1.0 / 2.1) * fx_ * 0.08 * 100.0 / (kHeight - 1);
    EXPECT_LT(expected, -6.0);
    const cv::Mat_<float> rolled = take(params, sideways(1.5));
    EXPECT_NEAR(leanOf(rolled), expected, 0.12);
    EXPECT_NEAR(edgeIn(rolled, 60).at, kWidth / 2.0, 0.3);
    EXPECT_NEAR(leanOf(take(params, sideways(-1.5))), -expected, 0.12);
    // With lens distortion the image is rendered undistorted, but a row keeps its time: its content
    // comes from further outside and appears nearer to the middle.
    params.k1 = -0.8;
    params.k2 = 0.5;
    const LensDistortion lens = distortionOf(params);
    const auto straight = lens.straighten({0.0, 50.0 / fx_});
    ASSERT_TRUE(straight);
    const double nearer = lens.bend({1e-6, straight->y()}).x() / 1e-6;
    EXPECT_LT(nearer, 0.9);
    EXPECT_NEAR(leanOf(take(params, sideways(1.5))), nearer * expected, 0.12);
}

TEST_F(SensorPicturesGl, WhatIsOutOfFocusHasTheThinLensCircle) {
    const Trajectory still = sideways(0.0);
    const double sharp = edgeIn(take(ideal(), still), 60).width;
    SensorParams params = ideal();
    params.looks = 128;
    params.aperture_mm = 60.0;
    for (const double focus : {0.8, 5.0}) {
        params.focus_m = focus;
        const double circle = 0.06 * fx_ * std::abs(1.0 / 2.0 - 1.0 / focus);
        EXPECT_GT(circle, 2.0);
        // Across an edge a disc spreads light with the deviation diameter / 4.
        const double expected = std::hypot(std::sqrt(12.0) * circle / 4.0, sharp);
        EXPECT_NEAR(edgeIn(take(params, still), 60).width, expected, 0.12 * expected) << focus;
    }
    params.focus_m = 2.0;
    EXPECT_LT(edgeIn(take(params, still), 60).width, sharp + 0.2) << "the plane in focus";
    params.focus_m = 0.0;
    EXPECT_LT(edgeIn(take(params, still), 60).width, sharp + 0.3)
        << "focused on the thing in the middle: the board";
}

TEST_F(SensorPicturesGl, ThingsThatMoveAreBlurredToo) {
    std::vector<ObjectMotion> motions(1);
    motions[0].object_id = scene_.objects.back().id;
    for (int i = 0; i < 3; ++i) {
        motions[0].by_frame.emplace_back(Eigen::Translation3d(0.15 * (i - 1), 0, 0));
    }
    SensorParams params = ideal();
    params.shutter_s = 0.08;
    const double expected = 1.5 / 2.0 * fx_ * 0.08;
    const double still = edgeIn(take(params, sideways(0.0)), 60).width;
    motions_ = motions;
    EXPECT_NEAR(edgeIn(take(params, sideways(0.0)), 60).width, expected, 0.6);
    EXPECT_LT(still, 1.5);
    // The image without sensor effects shows the object at its position at the frame's time.
    EXPECT_NEAR(edgeIn(take(params, sideways(0.0), "rgb"), 60).at, kWidth / 2.0, 0.3);
}

TEST_F(SensorPicturesGl, JpegOfLessQualityIsSmaller) {
    std::map<int, std::uintmax_t> sizes;
    SensorParams params = ideal();
    params.white_e = 1000.0;
    for (const int quality : {30, 90}) {
        params.jpeg_quality = quality;
        (void)take(params, sideways(0.0));
        sizes[quality] = fs::file_size(folder_ / "out" / "rgb_sensor" / "000001.jpg");
        EXPECT_FALSE(fs::exists(folder_ / "out" / "rgb_sensor" / "000001.png"));
    }
    EXPECT_LT(2 * sizes[30], sizes[90]);
}

}  // namespace
}  // namespace dollytrack::render::sensor_pictures_gl_test
