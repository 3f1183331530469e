#include "render/sensors/exposure.h"

#include "engine/camera/camera_motion.h"
#include "render/scene/motion_hash.h"
#include "render/scene/object_paths.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dollytrack::render::exposure_test {
namespace {

constexpr int kHeight = 480;

SensorParams timed(double shutter_s, double readout_s, int looks = 16) {
    SensorParams params = sensorPreset(SensorPreset::Ideal);
    params.shutter_s = shutter_s;
    params.readout_s = readout_s;
    params.looks = looks;
    return params;
}

/// Weighted means over the samples (looks) that make up a row.
struct RowMeans {
    double weight = 0.0;
    double time_s = 0.0;
    double deviation_s = 0.0;
    Eigen::Vector2d aperture = Eigen::Vector2d::Zero();
    Eigen::Vector2d aside_px = Eigen::Vector2d::Zero();
};

RowMeans meansOf(const Exposure& exposure, double y) {
    RowMeans means;
    double squares = 0.0;
    for (const ExposureSample& sample : exposure.samples()) {
        const double weight = exposure.weight(sample, y);
        means.weight += weight;
        means.time_s += weight * sample.after_s;
        squares += weight * sample.after_s * sample.after_s;
        means.aperture += weight * sample.aperture;
        means.aside_px += weight * sample.aside_px;
    }
    means.deviation_s = std::sqrt(std::max(0.0, squares - means.time_s * means.time_s));
    return means;
}

TEST(Exposure, SamplesAreSpreadOverTheShutter) {
    const Exposure exposure(timed(0.02, 0.0), kHeight, 3);
    ASSERT_EQ(exposure.samples().size(), 16U);
    const RowMeans first = meansOf(exposure, 0.5);
    EXPECT_NEAR(first.time_s, 0.0, 1e-12);
    // A uniform distribution has the deviation shutter / sqrt(12).
    EXPECT_NEAR(first.deviation_s, 0.02 / std::sqrt(12.0), 0.0001);
    EXPECT_EQ(meansOf(exposure, kHeight - 0.5).time_s, first.time_s) << "all rows at once";
    EXPECT_EQ(meansOf(Exposure(timed(0.0, 0.0), kHeight, 3), 0.5).deviation_s, 0.0);
}

TEST(Exposure, RowsOfARollingShutterHaveTheirOwnTimeAndTheSamePointsExactly) {
    for (const auto& [shutter, readout] :
         {std::pair(1.0 / 60.0, 0.015), {0.002, 0.02}, {0.03, 0.005}, {0.0, 0.02}}) {
        for (const int looks : {1, 2, 5, 16}) {
            const Exposure exposure(timed(shutter, readout, looks), kHeight, 0);
            EXPECT_LE(static_cast<int>(exposure.samples().size()), 4 * looks);
            const double row_s = std::max(shutter, readout / looks);
            EXPECT_EQ(exposure.rowExposureSeconds(), row_s);
            for (int row = 0; row < kHeight; ++row) {
                const RowMeans means = meansOf(exposure, row + 0.5);
                const double expected_s = readout * (row / (kHeight - 1.0) - 0.5);
                ASSERT_NEAR(means.weight, 1.0, 1e-12) << row;
                ASSERT_NEAR(means.time_s, expected_s, 1e-12) << row << " of " << looks;
                // Evenly over the exposure, with straight lines between consecutive samples.
                const double step_s = exposure.sampleStepSeconds();
                ASSERT_NEAR(means.deviation_s,
                            std::sqrt(row_s * row_s / 12.0 + step_s * step_s / 6.0), 1e-9);
                ASSERT_LT(means.aperture.norm(), 1e-12) << row << " of " << looks;
                ASSERT_LT(means.aside_px.norm(), 1e-12) << row << " of " << looks;
            }
        }
    }
}

TEST(Exposure, SamplesMeetInTheMiddleOfPixelAndAperture) {
    SensorParams params = timed(0.01, 0.0, 32);
    const Exposure exposure(params, kHeight, 7);
    Eigen::Vector2d lens = Eigen::Vector2d::Zero(), aside = lens;
    double farthest = 0.0, moment = 0.0;
    for (const ExposureSample& sample : exposure.samples()) {
        lens += sample.aperture;
        aside += sample.aside_px;
        farthest = std::max(farthest, sample.aperture.norm());
        moment += sample.aperture.squaredNorm() / 32.0;
    }
    EXPECT_NEAR(lens.norm(), 0.0, 1e-12);
    EXPECT_NEAR(aside.norm(), 0.0, 1e-12);
    EXPECT_LT(farthest, 1.15);
    EXPECT_NEAR(moment, 0.5, 0.05) << "the mean square of an evenly covered disc";

    const auto first = [](const SensorParams& of, int frame) {
        return Exposure(of, kHeight, frame).samples().front().aperture;
    };
    EXPECT_NE(first(params, 7), first(params, 8));
    SensorParams other = params;
    other.sensor_seed = 2;
    EXPECT_NE(first(params, 7), first(other, 7));
    EXPECT_EQ(first(params, 7), Exposure(params, kHeight, 7).samples().front().aperture);
}

Trajectory turning() {
    Trajectory trajectory;
    for (int i = 0; i < 12; ++i) {
        TrajectoryFrame frame;
        frame.time_s = 5.0 + 0.1 * i;
        frame.path = i < 11 ? 0 : 1;
        const double angle = 0.8 * frame.time_s;
        frame.pose = {Eigen::Vector3d(2 * std::cos(angle), 2 * std::sin(angle), 1.5),
                      Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()))};
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

TEST(CameraMotion, FollowsTheCurveBetweenFramesAndNotItsChord) {
    const Trajectory trajectory = turning();
    const CameraMotion motion(trajectory);
    const double angle = 0.8 * 5.55;
    const Eigen::Vector3d exact(2 * std::cos(angle), 2 * std::sin(angle), 1.5);
    const Pose between = motion.poseAt(5, 0.05);
    EXPECT_LT((between.position - exact).norm(), 1e-5);
    EXPECT_LT(angleBetween(between.rotation,
                           Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()))),
              1e-5);
    const Eigen::Vector3d chord =
        0.5 * (trajectory.frames[5].pose.position + trajectory.frames[6].pose.position);
    EXPECT_GT((chord - exact).norm(), 1e-3) << "straight between the frames is somewhere else";
    EXPECT_LT((motion.poseAt(6, -0.05).position - between.position).norm(), 1e-12);
    EXPECT_EQ(motion.poseAt(5, 0.0), trajectory.frames[5].pose);
}

TEST(CameraMotion, PassesTheFramesThatWereLeftOut) {
    const Trajectory all = turning();
    std::vector<char> keep(all.frames.size(), 0);
    for (const std::size_t kept : {0, 4, 9, 10, 11}) keep[kept] = 1;
    const Trajectory fewer = keepOnly(all, keep);
    ASSERT_EQ(fewer.frames.size(), 5U);
    const CameraMotion motion(fewer);
    EXPECT_EQ(motion.poseAt(1, 0.35), CameraMotion(all).poseAt(4, 0.35));
    EXPECT_EQ(motion.poseAt(4, 0.1), all.frames[11].pose) << "a path of one frame";
    // An export is not continued with another motion between the same frames.
    Trajectory without = fewer;
    without.left_out.clear();
    EXPECT_NE(render::trajectoryHash(fewer), render::trajectoryHash(without));
}

TEST(CameraMotion, GoesStraightOnAtTheEndsAndStandsStillAlone) {
    const Trajectory trajectory = turning();
    const CameraMotion motion(trajectory);
    const Pose& first = trajectory.frames[0].pose;
    const Eigen::Vector3d before = motion.poseAt(0, -0.01).position - first.position;
    EXPECT_NEAR(before.norm(), 0.016, 0.0005) << "at 1.6 m/s";
    EXPECT_EQ(motion.poseAt(11, 0.02), trajectory.frames[11].pose) << "a path of one frame";
}

TEST(ObjectPaths, ThingsGoStraightOnAndTurnEvenly) {
    const Scene scene = dollytrack::test::furnishedRoom();
    const int id = scene.objects.back().id;
    const Eigen::Vector3d middle = scene.object(id).box.center;
    Trajectory trajectory;
    ObjectMotion motion{id, {}};
    for (int i = 0; i < 3; ++i) {
        TrajectoryFrame frame;
        frame.time_s = 0.1 * i;
        trajectory.frames.push_back(frame);
        motion.by_frame.push_back(Eigen::Translation3d(middle + Eigen::Vector3d(0.2 * i, 0, 0)) *
                                  Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d::UnitZ()) *
                                  Eigen::Translation3d(-middle));
    }
    const ObjectPaths paths(scene, trajectory, {motion});
    const Eigen::Isometry3d between = paths.at(0.125).front().motion;
    EXPECT_LT((between * middle - (middle + Eigen::Vector3d(0.25, 0, 0))).norm(), 1e-9);
    EXPECT_NEAR(Eigen::AngleAxisd(between.rotation()).angle(), 0.375, 1e-9);
    EXPECT_LT((paths.at(-1.0).front().motion.matrix() - motion.by_frame[0].matrix()).norm(), 1e-9);
    EXPECT_LT((paths.at(9.0).front().motion.matrix() - motion.by_frame[2].matrix()).norm(), 1e-9);
}

TEST(SensorParams, APresetSetsTheCameraAndWhatFollowsChangesIt) {
    SensorParams params;
    params.sensor_seed = 9;
    params.depth_noise = DepthNoise::Redwood;
    const FieldList fields = listSensorFields(params);
    ASSERT_TRUE(setField(fields, "sensor_preset=webcam"));
    EXPECT_EQ(params.jpeg_quality, 75);
    EXPECT_EQ(params.sensor_seed, 9);
    EXPECT_EQ(params.depth_noise, DepthNoise::Redwood);
    ASSERT_TRUE(setField(fields, "jpeg_quality=60"));
    EXPECT_EQ(params.jpeg_quality, 60);
    EXPECT_LT(params.k1, 0.0);
    EXPECT_EQ(sensorPreset(SensorPreset::Phone), SensorParams{});
    const Status wrong = setField(fields, "shutter=1");
    ASSERT_FALSE(wrong);
    EXPECT_NE(describe(wrong.error()).find("shutter_s"), std::string::npos);
}

}  // namespace
}  // namespace dollytrack::render::exposure_test
