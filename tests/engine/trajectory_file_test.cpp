#include "engine/io/trajectories/trajectory_file.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace dollytrack::trajectory_file_test {
namespace {

using Eigen::Vector3d;

/// The expected first pose of a file in the world frame.
struct Expected {
    const char* format;
    const char* name;
    const char* text;
    Vector3d position, forward, down;
};

TrajectoryReading yUpScene() {
    TrajectoryReading reading;
    reading.camera_json_from_world.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return reading;
}

class ByHand : public testing::TestWithParam<Expected> {};

}  // namespace

TEST_P(ByHand, IsReadAsItsFormatSays) {
    const Expected& expected = GetParam();
    const test::TempFolder folder;
    const auto path = folder.write(expected.name, expected.text);
    const auto loaded = loadTrajectory(path, yUpScene());
    ASSERT_TRUE(loaded) << describe(loaded.error());
    EXPECT_EQ(loaded->format, expected.format);
    const Pose& pose = loaded->trajectory.frames.front().pose;
    EXPECT_NEAR((pose.position - expected.position).norm(), 0.0, 1e-9) << pose.position;
    EXPECT_NEAR((pose.forward() - expected.forward).norm(), 0.0, 1e-9) << pose.forward();
    const Vector3d down = pose.rotation * Vector3d::UnitY();
    EXPECT_NEAR((down - expected.down).norm(), 0.0, 1e-9) << down;
}

INSTANTIATE_TEST_SUITE_P(
    TrajectoryFile, ByHand,
    testing::Values(
        // The camera's axes equal the world's, so it looks up along z.
        Expected{"tum",
                 "groundtruth.txt",
                 "# timestamp tx ty tz qx qy qz qw\n10.5 1 2 3 0 0 0 1\n",
                 {1, 2, 3},
                 {0, 0, 1},
                 {0, 1, 0}},
        // A quarter turn about z maps the camera's y axis to -x.
        Expected{"tum",
                 "a.tum",
                 "0,1,2,3,0,0,0.70710678,0.70710678\r\n",
                 {1, 2, 3},
                 {0, 0, 1},
                 {-1, 0, 0}},
        // North is the world's x, east is -y, down is -z; without rotation the camera looks north.
        Expected{
            "tartanair", "pose_left.txt", "1 2 3 0 0 0 1\n", {1, -2, -3}, {1, 0, 0}, {0, 0, -1}},
        // KITTI's first camera looks along the world's y.
        Expected{"kitti", "00.txt", "1 0 0 1 0 1 0 2 0 0 1 3\n", {1, 3, -2}, {0, 1, 0}, {0, 0, -1}},
        // camera_from_world: the centre is minus the translation; images are ordered by name.
        Expected{"colmap",
                 "images.txt",
                 "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n"
                 "1 1 0 0 0 9 9 9 1 b.png\n\n2 1 0 0 0 1 2 3 1 a.png\n0.5 0.5 -1\n",
                 {-1, -2, -3},
                 {0, 0, 1},
                 {0, 1, 0}},
        // world_from_camera with y up and z back: without rotation the camera looks down.
        Expected{"transforms",
                 "transforms.json",
                 R"({"camera_angle_x": 1.0, "frames": [{"file_path": "a", "transform_matrix":
                     [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]}]})",
                 {1, 2, 3},
                 {0, 0, -1},
                 {0, -1, 0}},
        // y up: (x, y, z) is (x, -z, y) in the world.
        Expected{"3d-front",
                 "camera.json",
                 R"([{"pos":[1,2,3],"target":[1,2,1],"fov":60}])",
                 {1, -3, 2},
                 {0, 1, 0},
                 {0, 0, -1}},
        // The mean of the poses at shutter open and close.
        Expected{"scenenet",
                 "description.txt",
                 "layout_file: ./x.obj\nobject\na/b\n#first three elements, eye and last three, "
                 "lookAt\n#frame rate per second: 25\n\n0.0 0 2 3  1 2 1\n0.02 2 2 3  1 2 1\n",
                 {1, -3, 2},
                 {0, 1, 0},
                 {0, 0, -1}}),
    [](const auto& test) {
        std::string name = std::string(test.param.format) + "_" + std::to_string(test.index);
        name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
        return name;
    });

TEST(TrajectoryFile, TimesAreTheFilesOrEven) {
    const test::TempFolder folder;
    const auto timed = loadTrajectory(
        folder.write("a.txt", "2 0 0 0 0 0 0 1\n2.25 0 0 1 0 0 0 1\n2.5 0 0 2 0 0 0 1\n"), {});
    ASSERT_TRUE(timed);
    EXPECT_TRUE(timed->timed);
    EXPECT_EQ(timed->trajectory.frames[2].time_s, 2.5);
    EXPECT_EQ(timed->trajectory.frame_interval_s, 0.25);
    TrajectoryReading reading;
    reading.interval_s = 0.2;
    const auto even =
        loadTrajectory(folder.write("b.txt", "0 0 0 0 0 0 1\n0 0 1 0 0 0 1\n"), reading);
    ASSERT_TRUE(even);
    EXPECT_FALSE(even->timed);
    EXPECT_NEAR(even->trajectory.frames[1].time_s, 0.2, 1e-12);
    const std::string row = "1 0 0 0 0 1 0 0 0 0 1 0\n";
    const auto kitti_path = folder.write("poses.txt", row + row);
    (void)folder.write("times.txt", "0.0\n0.5\n");
    const auto kitti = loadTrajectory(kitti_path, {});
    ASSERT_TRUE(kitti);
    EXPECT_TRUE(kitti->timed);
    EXPECT_EQ(kitti->trajectory.frames[1].time_s, 0.5);
}

// A mirrored scene in centimetres, y up: the camera has the right position and is not mirrored.
TEST(TrajectoryFile, TheScenesOwnWorldMayBeScaledAndMirrored) {
    const test::TempFolder folder;
    TrajectoryReading reading;
    reading.world = "scene";
    reading.source_from_world.linear() << -100, 0, 0, 0, 0, 100, 0, -100, 0;
    const auto path = folder.write("a.txt", "0 100 200 300 0 0 0 1\n");
    const auto loaded = loadTrajectory(path, reading);
    ASSERT_TRUE(loaded);
    const Pose& pose = loaded->trajectory.frames.front().pose;
    EXPECT_NEAR((pose.position - Vector3d(-1, -3, 2)).norm(), 0.0, 1e-9);
    EXPECT_NEAR((pose.forward() - Vector3d(0, -1, 0)).norm(), 0.0, 1e-9);
    EXPECT_NEAR((pose.rotation * Vector3d::UnitY() - Vector3d(0, 0, 1)).norm(), 0.0, 1e-9);
    EXPECT_NEAR(pose.rotation.norm(), 1.0, 1e-12);
}

TEST(TrajectoryFile, TheLensIsReadWhereTheFileTellsIt) {
    const test::TempFolder folder;
    const auto images = folder.write("images.txt", "1 1 0 0 0 0 0 0 1 a.png\n\n");
    (void)folder.write("cameras.txt", "# cameras\n1 PINHOLE 640 480 320 320 320 240\n");
    const auto colmap = loadTrajectory(images, {});
    ASSERT_TRUE(colmap && colmap->hfov_deg);
    EXPECT_NEAR(*colmap->hfov_deg, 90.0, 1e-9);
}

// Names numbered without leading zeros: a10 comes after a9, not after a1.
TEST(TrajectoryFile, ColmapImagesFollowEachOtherAsTheyAreNumbered) {
    const test::TempFolder folder;
    std::string text;
    for (const int number : {10, 2, 0, 11, 1, 9}) {
        // Without rotation, so that the camera is at minus its translation.
        text += "1 1 0 0 0 -" + std::to_string(number) + " 0 0 1 seq2/a" + std::to_string(number) +
                ".png\n\n";
    }
    const auto loaded = loadTrajectory(folder.write("images.txt", text), {});
    ASSERT_TRUE(loaded) << describe(loaded.error());
    std::vector<double> along;
    for (const TrajectoryFrame& frame : loaded->trajectory.frames) {
        along.push_back(frame.pose.position.x());
    }
    EXPECT_EQ(along, (std::vector<double>{0, 1, 2, 9, 10, 11}));
}

TEST(TrajectoryFile, AMissingFileIsSaidToBeMissing) {
    const test::TempFolder folder;
    const auto missing = loadTrajectory(folder.path() / "nowhere.txt", {});
    ASSERT_FALSE(missing);
    EXPECT_NE(describe(missing.error()).find("no such file"), std::string::npos);
    EXPECT_NE(describe(missing.error()).find("nowhere.txt"), std::string::npos);
}

TEST(TrajectoryFile, RoomsAndViewsWithoutTimesAreNoMotion) {
    const test::TempFolder folder;
    const auto views =
        loadTrajectory(folder.write("views.json", R"([{"pos":[0,0,0],"target":[1,0,0],"fov":60},
                                       {"pos":[0,0,1],"target":[1,0,0],"fov":60}])"),
                       {});
    ASSERT_TRUE(views);
    EXPECT_NE(views->trajectory.frames[0].path, views->trajectory.frames[1].path);
    const auto rooms =
        loadTrajectory(folder.write("rooms.json",
                                    R"([{"pos":[0,0,0],"target":[1,0,0],"fov":60,"time":0,"room":0},
                         {"pos":[0,0,1],"target":[1,0,0],"fov":60,"time":1,"room":0},
                         {"pos":[9,0,1],"target":[1,0,0],"fov":60,"time":2,"room":1}])"),
                       {});
    ASSERT_TRUE(rooms);
    EXPECT_EQ(rooms->trajectory.frames[0].path, rooms->trajectory.frames[1].path);
    EXPECT_NE(rooms->trajectory.frames[1].path, rooms->trajectory.frames[2].path);
}

// Every bad file gives one sentence with its position.
TEST(TrajectoryFile, BadFilesSayWhere) {
    struct Case {
        const char* name;
        const char* text;
        const char* format;
        const char* where;
        const char* word;
    };
    for (const Case& bad : {
             Case{"a.txt", "0 0 0 0 0 0 0 1\n1 0 0 zero 0 0 0 1\n", "tum", "a.txt:2", "zero"},
             Case{"b.txt", "# x\n0 0 0 0 0 0 1\n", "tum", "b.txt:2", "8 are needed"},
             Case{"c.txt", "0 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n", "", "c.txt:2", "later"},
             Case{"d.txt", "0 0 0 0 0 0 0 2\n", "tum", "d.txt:1", "length 2"},
             Case{"e.txt", "0 0 0 nan 0 0 0 1\n", "tum", "e.txt:1", "finite"},
             Case{"f.txt", "2 0 0 1 0 1 0 2 0 0 1 3\n", "", "f.txt:1", "rotation"},
             Case{"images.txt", "1 1 0 0 0 9 9 9 1 b.png\n2 1 0 0 0 1 2 3 1 a.png\n3 1 0\n", "",
                  "images.txt:3", "second line"},
             Case{"g.json", "{\"frames\": [{\"transform_matrix\": [[1, 0]]}]}", "", "frames[0]",
                  "transforms.json"},
             Case{"h.json", "[{\"pos\": [0, 0, 0]}]", "", "[0]", "target"},
             Case{"i.json", "[{\"pos\":", "", "i.json:1:9", "not valid JSON"},
             Case{"j.txt", "0 0 0 0 1 1 1\n", "scenenet", "j.txt:1", "shutter"},
             Case{"k.txt", "0 0 0 0 0 1 0\n0 0 0 0 0 1 0\n", "scenenet", "k.txt:1", "up or down"},
             Case{"l.hdf5", "not HDF5", "", "camera_keyframe_positions.hdf5", "HDF5"},
             Case{"m.txt", "", "", "m.txt", "known format"},
             Case{"n.txt", "# only remarks\n", "tum", "n.txt", "no lines of values"},
             Case{"o.txt", "0 0 0 0 0 0 0 1\n1 0 2e6 0 0 0 0 1\n", "", "o.txt:2", "1000 km"},
             Case{"p.txt", "1e300 0 0 0 0 0 1\n", "tartanair", "p.txt:1", "1000 km"},
             Case{"q.json",
                  R"([{"pos":[0,0,0],"target":[1,0,0],"time":5},
                      {"pos":[0,0,1],"target":[1,0,0],"time":1}])",
                  "", "[1]", "later"},
             Case{"r.json", R"([{"pos":[0,0,0],"target":[1e300,0,0],"time":5}])", "", "[0]",
                  "roll"},
         }) {
        const test::TempFolder folder;
        TrajectoryReading reading;
        reading.format = bad.format;
        const auto loaded = loadTrajectory(folder.write(bad.name, bad.text), reading);
        ASSERT_FALSE(loaded) << bad.name;
        EXPECT_EQ(loaded.error().code, ErrorCode::BadInput) << bad.name;
        EXPECT_NE(loaded.error().where.find(bad.where), std::string::npos)
            << bad.name << " " << loaded.error().where;
        EXPECT_NE(loaded.error().message.find(bad.word), std::string::npos)
            << bad.name << " " << loaded.error().message;
    }
}

// Nothing is written into the pipe, so opening it as a file would block forever.
TEST(TrajectoryFile, NeitherPipesNorDevicesAreRead) {
    const test::TempFolder folder;
    const auto pipe = folder.path() / "poses";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder.path() / "zero");
    for (const auto& path : {pipe, folder.path() / "zero", std::filesystem::path("/dev/zero")}) {
        const auto loaded = loadTrajectory(path, {});
        ASSERT_FALSE(loaded) << path;
        EXPECT_EQ(loaded.error().code, ErrorCode::BadInput);
        EXPECT_NE(loaded.error().message.find("not an ordinary file"), std::string::npos);
    }
}

// Copying a JSON value is recursive, so 200,000 levels would overflow the stack.
TEST(TrajectoryFile, DeepNestingIsRefused) {
    const test::TempFolder folder;
    const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
    for (const std::string& text : {R"([{"pos":[0,0,0],"target":[1,0,0],"room":)" + deep + "}]",
                                    R"({"frames":)" + deep + "}"}) {
        const auto loaded = loadTrajectory(folder.write("deep.json", text), {});
        ASSERT_FALSE(loaded);
        EXPECT_EQ(loaded.error().code, ErrorCode::BadInput);
        EXPECT_NE(loaded.error().message.find("nested more than 64 levels deep"),
                  std::string::npos);
    }
}

// If all lines have the same time, the trajectory has no times.
TEST(TrajectoryFile, SceneNetsEqualTimesAreNone) {
    const test::TempFolder folder;
    const std::string pair = "1 0 0 0 1 0 0\n1 0 0 0 1 0 0\n";
    TrajectoryReading reading;
    reading.format = "scenenet";
    const auto loaded = loadTrajectory(folder.write("a.txt", pair + pair), reading);
    ASSERT_TRUE(loaded) << describe(loaded.error());
    EXPECT_FALSE(loaded->timed);
}

TEST(TrajectoryFile, UnknownNamesAreUsageErrors) {
    const test::TempFolder folder;
    const auto path = folder.write("a.txt", "0 0 0 0 0 0 0 1\n");
    TrajectoryReading format;
    format.format = "tumm";
    EXPECT_EQ(loadTrajectory(path, format).error().code, ErrorCode::Usage);
    TrajectoryReading world;
    world.world = "upwards";
    EXPECT_EQ(loadTrajectory(path, world).error().code, ErrorCode::Usage);
}

}  // namespace dollytrack::trajectory_file_test
