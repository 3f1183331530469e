#include "render/dataset_folder.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace dollytrack::render {
namespace {

namespace fs = std::filesystem;

// dataset.json is a common name: what others put in theirs must not cost them their pictures.
TEST(DatasetFolder, RefusesADatasetOfSomebodyElse) {
    for (const char* card :
         {"{}", R"({"format": "coco"})", R"({"info": {"format": "dollytrack dataset"}})",
          R"(["dollytrack dataset"])", R"({"format": "dollytrack dataset")", ""}) {
        const test::TempFolder folder;
        fs::create_directories(folder.path() / "rgb");
        const fs::path picture = folder.write("rgb/000000.png", "mine");
        const fs::path theirs = folder.write("dataset.json", card);
        const Status refused = prepareDatasetFolder(folder.path(), false, 1);
        ASSERT_FALSE(refused) << card;
        EXPECT_EQ(refused.error().code, ErrorCode::CannotWrite);
        EXPECT_TRUE(fs::exists(picture)) << card;
        EXPECT_TRUE(fs::exists(theirs)) << card;
    }
    const test::TempFolder folder;
    fs::create_directories(folder.path() / "dataset.json");
    EXPECT_FALSE(prepareDatasetFolder(folder.path(), false, 1));
}

TEST(DatasetFolder, TakesOverItsOwnDatasets) {
    const test::TempFolder finished;
    fs::create_directories(finished.path() / "rgb");
    const fs::path old = finished.write("rgb/000007.png", "old");
    const fs::path card = finished.write(
        "dataset.json", R"({"format": "dollytrack dataset", "files": {"rgb/000007.png": ""}})");
    ASSERT_TRUE(prepareDatasetFolder(finished.path(), false, 1));
    EXPECT_FALSE(fs::exists(old));
    EXPECT_FALSE(fs::exists(card));
    // Now it is marked as one cut off.
    (void)finished.write("rgb/000001.png", "half");
    EXPECT_TRUE(prepareDatasetFolder(finished.path(), false, 1));
    EXPECT_FALSE(fs::exists(finished.path() / "rgb/000001.png"));
}

}  // namespace
}  // namespace dollytrack::render
