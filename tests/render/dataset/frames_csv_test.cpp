#include "render/formats/tables/frames_csv.h"

#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <sstream>

namespace dollytrack::render::frames_csv_test {
namespace {

std::vector<std::vector<std::string>> rowsOf(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        auto& row = rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    }
    return rows;
}

DatasetFrame frameAt(double time_s, double y, int path) {
    DatasetFrame frame;
    frame.camera.time_s = time_s;
    frame.camera.path = path;
    frame.camera.pose = lookAt({1.0, y, 1.0}, {2.0, y, 1.0});
    frame.clearance_m = 0.25;
    frame.room = "room 1";
    return frame;
}

TEST(FramesCsv, SaysWhatEachFrameShowsAndHowTheCameraCameThere) {
    const Scene scene = test::furnishedRoom();
    std::vector<int> targets;
    int wall = 0;
    for (const Object& object : scene.objects) {
        if (object.role == Role::Target) targets.push_back(object.id);
        if (object.role != Role::Target) wall = object.id;
    }
    ASSERT_GE(targets.size(), 2U);
    DatasetContents contents{scene, {}, {}, {}};
    contents.frames = {frameAt(0.0, 0.5, 0), frameAt(0.1, 0.54, 0), frameAt(0.4, 0.60, 0),
                       frameAt(0.5, 2.0, 1)};
    contents.frames[2].camera.position_point = 7;
    contents.frames[2].source_frame = 4;
    contents.frames[2].well_shown = {targets[0]};
    // Two boxes 10 x 30 with 20 between them (distance 30, diagonal 50), a wall, and a speck.
    contents.frames[0].masks = {{targets[0], {}, 300, {0, 0, 10, 30}},
                                {targets[1], {}, 300, {30, 0, 10, 30}},
                                {wall, {}, 9000, {0, 0, 100, 90}}};
    contents.frames[1].masks = {{targets[0], {}, 300, {0, 0, 10, 30}},
                                {targets[1], {}, 3, {30, 0, 2, 2}}};
    const auto rows = rowsOf(framesCsvText(contents));
    ASSERT_EQ(rows.size(), 5U);
    const std::vector<std::vector<std::string>> expected = {
        {"frame", "time_s", "trajectory_frame", "room", "path", "key_frame", "clearance_m",
         "speed_mps", "turn_dps", "targets", "well_shown", "score", "picture"},
        {"0", "0", "0", "room 1", "0", "0", "0.25", "", "", "2", "0", "1.6"},
        {"1", "0.1", "0", "room 1", "0", "0", "0.25", "0.4", "0", "1", "0", "1.5"},
        {"2", "0.4", "4", "room 1", "0", "1", "0.25", "0.2", "0", "0", "1", "0"},
        {"3", "0.5", "0", "room 1", "1", "0", "0.25", "", "", "0", "0", "0"},
    };
    EXPECT_EQ(rows, expected);
}

}  // namespace
}  // namespace dollytrack::render::frames_csv_test
