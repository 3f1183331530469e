#include "engine/camera/intrinsics.h"
#include "engine/core/random.h"
#include "engine/io/trajectories/trajectory_file.h"
#include "render/encoders/modalities.h"
#include "render/formats/poses/colmap.h"
#include "render/formats/poses/instant_ngp.h"
#include "render/formats/poses/kitti.h"
#include "render/formats/poses/nerfstudio.h"
#include "render/formats/poses/tartan_air.h"
#include "render/formats/poses/tum.h"
#include "render/formats/scenes/surface_sample.h"
#include "tests/support/scene_builder.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <sstream>

namespace dollytrack::render::pose_formats_test {
namespace {

/// Frames with random positions and orientations, so that no two axes can be confused.
DatasetContents randomFlight(const Scene& scene, std::uint64_t seed) {
    DatasetContents contents{scene, {}, {}, {}};
    contents.modalities = chooseModalities({"rgb", "depth"}).value();
    Random random(seed);
    for (int i = 0; i < 12; ++i) {
        DatasetFrame frame;
        frame.camera.time_s = 0.1 * i + 0.001 * random.uniform();
        frame.camera.pose.position = {random.uniform(0.5, 3.5), random.uniform(0.5, 2.5),
                                      random.uniform(0.3, 2.3)};
        frame.camera.pose.rotation =
            Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
                .normalized();
        contents.frames.push_back(frame);
    }
    return contents;
}

class PoseFormats : public testing::Test {
  protected:
    /// Writes a format's files into the folder, without their subfolders.
    std::map<std::string, std::string> write(const Format& format) {
        const auto files = format.write(contents_);
        EXPECT_TRUE(files);
        std::map<std::string, std::string> texts;
        for (const DatasetFile& file : *files) {
            EXPECT_NE(std::find(format.files.begin(), format.files.end(), file.path),
                      format.files.end())
                << file.path;
            const std::string name = std::filesystem::path(file.path).filename().string();
            (void)folder_.write(name, file.bytes);
            texts[name] = file.bytes;
        }
        return texts;
    }

    /// Checks that our reader of the format, which shares no code with the writer, returns the
    /// poses.
    void expectSame(const std::string& name, const std::string& format, bool relative = false) {
        TrajectoryReading reading;
        reading.format = format;
        reading.world = relative ? "z-up" : "";
        const auto loaded = loadTrajectory(folder_.path() / name, reading);
        ASSERT_TRUE(loaded) << describe(loaded.error());
        const auto& frames = loaded->trajectory.frames;
        ASSERT_EQ(frames.size(), contents_.frames.size());
        const Pose& first = contents_.frames.front().camera.pose;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const TrajectoryFrame& expected = contents_.frames[i].camera;
            Pose pose = frames[i].pose;
            if (relative) pose = {first.toWorld(pose.position), first.rotation * pose.rotation};
            EXPECT_LT((pose.position - expected.pose.position).norm(), 1e-7) << i;
            EXPECT_LT(angleBetween(pose.rotation, expected.pose.rotation), 1e-6) << i;
            if (loaded->timed) {
                EXPECT_NEAR(frames[i].time_s, expected.time_s, 1e-6);
            }
        }
    }

    Scene scene_ = test::furnishedRoom();
    DatasetContents contents_ = randomFlight(scene_, 5);
    test::TempFolder folder_;
};

TEST_F(PoseFormats, TumComesBack) {
    const auto texts = write(kTumFormat);
    expectSame("groundtruth.txt", "tum");
    EXPECT_EQ(texts.size(), 4U);
    std::istringstream lines(texts.at("associations.txt"));
    std::string rgb_time, rgb, depth_time, depth;
    for (int i = 0; lines >> rgb_time >> rgb >> depth_time >> depth; ++i) {
        EXPECT_EQ(rgb, frameFile("rgb", i));
        EXPECT_EQ(depth, frameFile("depth_tum", i));
        EXPECT_EQ(rgb_time, depth_time);
    }
}

// A list must not name images that do not exist.
TEST_F(PoseFormats, TumListsOnlyWhatIsThere) {
    contents_.modalities = chooseModalities({"depth"}).value();
    const auto texts = write(kTumFormat);
    EXPECT_EQ(texts.count("depth.txt"), 1U);
    EXPECT_EQ(texts.count("rgb.txt") + texts.count("associations.txt"), 0U);
}

TEST_F(PoseFormats, KittiComesBackFromItsFirstCamera) {
    const auto texts = write(kKittiFormat);
    expectSame("poses.txt", "kitti", true);
    const Intrinsics lens = makeIntrinsics(contents_.camera);
    std::istringstream text(texts.at("calib.txt"));
    std::string name;
    Eigen::Matrix<double, 3, 4, Eigen::RowMajor> p;
    int cameras = 0;
    while (text >> name) {
        for (int i = 0; i < 12; ++i) text >> p.data()[i];
        ASSERT_EQ(name.size(), 3U);
        EXPECT_EQ(name[1], static_cast<char>('0' + cameras++));
        // In this format integers are pixel centres: half a pixel less than ours.
        const Eigen::Vector3d at = p * Eigen::Vector4d(0.3, -0.2, 2.0, 1.0);
        // The second and fourth camera stand to the right, so they see it further left.
        const double right_m = cameras % 2 == 0 ? contents_.stereo_baseline_m : 0.0;
        const Eigen::Vector2d ours = lens.project({0.3 - right_m, -0.2, 2.0});
        EXPECT_NEAR(at.x() / at.z() + 0.5, ours.x(), 1e-6);
        EXPECT_NEAR(at.y() / at.z() + 0.5, ours.y(), 1e-6);
    }
    EXPECT_EQ(cameras, 4);
}

TEST_F(PoseFormats, TartanAirComesBack) {
    (void)write(kTartanAirFormat);
    expectSame("pose_left.txt", "tartanair");
}

TEST_F(PoseFormats, NerfstudioComesBack) {
    const auto texts = write(kNerfstudioFormat);
    expectSame("transforms.json", "transforms");
    const auto root = nlohmann::json::parse(texts.at("transforms.json"));
    EXPECT_EQ(root["frames"][3]["file_path"], "rgb/000003.png");
    EXPECT_EQ(root["frames"][3]["depth_file_path"], "depth/000003.png");
}

TEST_F(PoseFormats, InstantNgpComesBackAndFillsTheUnitCube) {
    const auto texts = write(kInstantNgpFormat);
    expectSame("transforms_ngp.json", "transforms");
    const auto root = nlohmann::json::parse(texts.at("transforms_ngp.json"));
    const auto offset = root["offset"].get<std::vector<double>>();
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& point : scene_.positions) {
        box.extend(root["scale"].get<double>() * point.cast<double>() +
                   Eigen::Vector3d::Map(offset.data()));
    }
    EXPECT_GE(box.min().minCoeff(), 0.0);
    EXPECT_LE(box.max().maxCoeff(), 1.0);
    EXPECT_GT(box.sizes().maxCoeff(), 0.8);
    EXPECT_NEAR(root["camera_angle_x"].get<double>(), contents_.camera.hfov_deg * M_PI / 180.0,
                1e-9);
}

TEST_F(PoseFormats, ColmapComesBackWithPointsThatAreSurface) {
    const auto texts = write(kColmapFormat);
    expectSame("images.txt", "colmap");
    std::istringstream lines(texts.at("points3D.txt"));
    std::string line;
    int points = 0;
    for (; std::getline(lines, line);) {
        if (line.starts_with("#")) continue;
        std::istringstream values(line);
        int id = 0;
        Eigen::Vector3d p;
        values >> id >> p.x() >> p.y() >> p.z();
        EXPECT_EQ(id, ++points);
        // All surfaces of the room are flat, so the point lies in some triangle's plane.
        bool near = false;
        for (const Object& object : scene_.objects) near |= object.box.contains(p, 1e-4);
        EXPECT_TRUE(near) << line;
    }
    EXPECT_GT(points, 10'000);
}

// Points are distributed by area: each object's share of points is its share of the surface.
TEST(SurfaceSample, IsEvenAndHasTheSurfacesColours) {
    test::SceneBuilder builder;
    builder.object("red", {kNyuOtherProp, Role::Target, {1, 0, 0}})
        .quad({0, 0, 0}, {3, 0, 0}, {0, 1, 0});
    builder.object("blue", {kNyuOtherProp, Role::Target, {0, 0, 0.2158605F}})
        .quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    const Scene scene = builder.build();
    const auto points = sampleSurface(scene, 4000, 3);
    ASSERT_EQ(points.size(), 4000U);
    int red = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const ColoredPoint& point : points) {
        if (point.position.z() > 0.5) {
            EXPECT_EQ(point.color, (std::array<std::uint8_t, 3>{0, 0, 128}));
            continue;
        }
        EXPECT_EQ(point.color, (std::array<std::uint8_t, 3>{255, 0, 0}));
        ++red;
        mean += point.position;
    }
    EXPECT_NEAR(red / 4000.0, 0.75, 0.03);
    EXPECT_NEAR(mean.x() / red, 1.5, 0.06);
    EXPECT_NEAR(mean.y() / red, 0.5, 0.03);
}

}  // namespace
}  // namespace dollytrack::render::pose_formats_test
