#include "render/dataset/contents/frame_folds.h"

#include "render/dataset/contents/dataset_contents.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"
#include "render/formats/tables/fold_files.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace dollytrack::render::frame_folds_test {
namespace {

/// A trajectory along a line at 10 frames per second; `rooms` gives the number of frames in each
/// room.
std::vector<DatasetFrame> trajectoryOf(const std::vector<int>& rooms) {
    std::vector<DatasetFrame> frames;
    for (std::size_t room = 0; room < rooms.size(); ++room) {
        for (int i = 0; i < rooms[room]; ++i) {
            DatasetFrame frame;
            const double at = static_cast<double>(frames.size());
            frame.camera.time_s = 0.1 * at;
            frame.camera.pose = lookAt({0.03 * at, 0, 1}, {0.03 * at, 5, 1});
            frame.room = "room " + std::to_string(room + 1);
            frames.push_back(frame);
        }
    }
    return frames;
}

/// Each frame is held out exactly once, and no fold uses a frame both for training and held out.
void expectSplit(const FrameFolds& split, std::size_t frames, int count) {
    ASSERT_EQ(split.folds.size(), static_cast<std::size_t>(count));
    std::vector<int> held_back(frames);
    for (const Fold& fold : split.folds) {
        EXPECT_TRUE(std::is_sorted(fold.train.begin(), fold.train.end()));
        EXPECT_FALSE(fold.train.empty());
        for (const int i : fold.val) ++held_back[i];
        std::vector<int> both;
        std::set_intersection(fold.train.begin(), fold.train.end(), fold.val.begin(),
                              fold.val.end(), std::back_inserter(both));
        EXPECT_TRUE(both.empty());
    }
    EXPECT_EQ(held_back, std::vector<int>(frames, 1));
}

TEST(FrameFolds, HoldsBackWholeRoomsWhereThereAreEnough) {
    const auto frames = trajectoryOf({30, 20, 25, 22, 28, 10, 12});
    const auto split = splitFrames(frames, {5, 7});
    ASSERT_TRUE(split);
    EXPECT_TRUE(split->by_room);
    expectSplit(*split, frames.size(), 5);
    for (const Fold& fold : split->folds) {
        std::set<std::string> learnt, held_back;
        for (const int i : fold.train) learnt.insert(frames[i].room);
        for (const int i : fold.val) held_back.insert(frames[i].room);
        EXPECT_EQ(learnt.size() + held_back.size(), 7U);
        EXPECT_EQ(fold.train.size() + fold.val.size(), frames.size());
    }
}

TEST(FrameFolds, KeepsBlocksApartInTimeAndPlace) {
    auto frames = trajectoryOf({200});
    // The trajectory returns: frame 150 has the pose of frame 20.
    frames[150].camera.pose = frames[20].camera.pose;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto split = splitFrames(frames, {5, seed});
        ASSERT_TRUE(split);
        EXPECT_FALSE(split->by_room);
        expectSplit(*split, frames.size(), 5);
        for (const Fold& fold : split->folds) {
            EXPECT_EQ(fold.val.size(), 40U);
            for (const int a : fold.val) {
                for (const int b : fold.train) {
                    EXPECT_GE(std::abs(a - b), 10);
                    EXPECT_FALSE((a == 20 && b == 150) || (a == 150 && b == 20));
                }
            }
        }
    }
    EXPECT_NE(splitFrames(frames, {5, 1})->folds[0].val, splitFrames(frames, {5, 2})->folds[0].val);
    EXPECT_EQ(splitFrames(frames, {5, 1})->folds[0].val, splitFrames(frames, {5, 1})->folds[0].val);
}

// The sizes of the rooms differ too much to hold out whole rooms.
TEST(FrameFolds, OneLargeRoomIsCutIntoBlocks) {
    EXPECT_FALSE(splitFrames(trajectoryOf({300, 5, 5, 5, 5}), {5, 1})->by_room);
}

TEST(FrameFolds, FewerFramesThanFoldsAreAUsageError) {
    const auto split = splitFrames(trajectoryOf({3}), {5, 1});
    ASSERT_FALSE(split);
    EXPECT_EQ(split.error().code, ErrorCode::Usage);
}

TEST(FoldFiles, ListPicturesAndAnnotateThem) {
    const Scene scene = test::furnishedRoom();
    DatasetContents contents{scene, {}, {}, trajectoryOf({60})};
    contents.modalities = chooseModalities({"rgb"}).value();
    contents.folds = {3, 1};
    const auto files = foldFiles(contents, chooseFormats({"coco"}).value());
    ASSERT_TRUE(files);
    EXPECT_EQ(files->size(), 12U);
    const Fold fold = splitFrames(contents.frames, contents.folds)->folds[1];
    for (const DatasetFile& file : *files) {
        EXPECT_TRUE(isFoldFile(file.path.substr(6))) << file.path;
        if (file.path == "folds/fold_1_val.txt") {
            std::string expected;
            for (const int i : fold.val) expected += frameFile("rgb", i) + "\n";
            EXPECT_EQ(file.bytes, expected);
        }
        if (file.path == "folds/fold_1_val.json") {
            const auto images = nlohmann::json::parse(file.bytes)["images"];
            ASSERT_EQ(images.size(), fold.val.size());
            EXPECT_EQ(images[0]["id"], fold.val[0] + 1);
        }
    }
    EXPECT_FALSE(isFoldFile("fold_x_val.txt"));
    EXPECT_FALSE(isFoldFile("fold_1_val.txt.bak"));
    EXPECT_TRUE(isFoldFile("fold_1_val.txt.tmp.12"));
}

}  // namespace
}  // namespace dollytrack::render::frame_folds_test
