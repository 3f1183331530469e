#include "render/dataset_folder.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <sys/statvfs.h>

#include <limits>
#include <string>

namespace dollytrack::render {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = ".dollytrack-export";
constexpr const char* kOurCard =
    R"({"format": "dollytrack dataset", "files": {"rgb/000007.png": ""}})";

ModalitySet allModalities() {
    return *chooseModalities({});
}

// dataset.json is a common name: what others put in theirs must not cost them their pictures.
TEST(DatasetFolder, RefusesADatasetOfSomebodyElse) {
    for (const char* card :
         {"{}", R"({"format": "coco"})", R"({"info": {"format": "dollytrack dataset"}})",
          R"(["dollytrack dataset"])", R"({"format": "dollytrack dataset")", ""}) {
        const test::TempFolder folder;
        const fs::path picture = folder.write("rgb/000000.png", "mine");
        const fs::path theirs = folder.write("dataset.json", card);
        const auto refused = DatasetFolder::claim(folder.path(), false);
        ASSERT_FALSE(refused) << card;
        EXPECT_EQ(refused.error().code, ErrorCode::CannotWrite);
        EXPECT_TRUE(fs::exists(picture)) << card;
        EXPECT_TRUE(fs::exists(theirs)) << card;
        EXPECT_FALSE(fs::exists(folder.path() / kMark)) << card;
    }
    const test::TempFolder folder;
    fs::create_directories(folder.path() / "dataset.json");
    EXPECT_FALSE(DatasetFolder::claim(folder.path(), false));
}

TEST(DatasetFolder, KeepsAnEarlierDatasetUntilTheNewOneBegins) {
    const test::TempFolder folder;
    const fs::path picture = folder.write("rgb/000007.png", "old");
    const fs::path card = folder.write("dataset.json", kOurCard);
    const fs::path notes = folder.write("notes.txt", "mine");
    {
        auto claimed = DatasetFolder::claim(folder.path(), false);
        ASSERT_TRUE(claimed);
        EXPECT_TRUE(claimed->isComplete());
        EXPECT_FALSE(claimed->checkSpace(std::numeric_limits<std::uint64_t>::max() / 2, {}));
    }
    EXPECT_TRUE(fs::exists(picture));
    EXPECT_TRUE(fs::exists(card));
    EXPECT_FALSE(fs::exists(folder.path() / kMark));
    {
        auto claimed = DatasetFolder::claim(folder.path(), false);
        ASSERT_TRUE(claimed);
        ASSERT_TRUE(claimed->begin(allModalities(), {}, {}));
        EXPECT_FALSE(claimed->isComplete());
    }
    EXPECT_FALSE(fs::exists(picture));
    EXPECT_FALSE(fs::exists(card));
    EXPECT_TRUE(fs::exists(notes));
    // Now it is marked as one cut off.
    EXPECT_TRUE(fs::exists(folder.path() / kMark));
    EXPECT_TRUE(DatasetFolder::claim(folder.path(), false));
}

TEST(DatasetFolder, RemovesWhatAKilledExportLeftButForWhatIsKept) {
    const test::TempFolder folder;
    for (const char* name :
         {kMark, "rgb/000000.png", "rgb/000001.png", "rgb/000001.png.tmp.123", "depth/000000.png",
          "semantic/000000.png", "annotations.json.tmp.77", "rgb/mine.png"}) {
        (void)folder.write(name, "x");
    }
    auto claimed = DatasetFolder::claim(folder.path(), false);
    ASSERT_TRUE(claimed);
    ASSERT_TRUE(claimed->begin(*chooseModalities({"rgb", "instance"}), {}, {"rgb/000000.png"}));
    std::set<std::string> left;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
        left.insert(fs::relative(entry.path(), folder.path()).string());
    }
    EXPECT_EQ(left,
              (std::set<std::string>{kMark, "instance", "rgb", "rgb/000000.png", "rgb/mine.png"}));
}

TEST(DatasetFolder, IsLockedAgainstASecondExport) {
    const test::TempFolder folder;
    {
        const auto first = DatasetFolder::claim(folder.path(), false);
        ASSERT_TRUE(first);
        const auto second = DatasetFolder::claim(folder.path(), true);
        ASSERT_FALSE(second);
        EXPECT_EQ(second.error().code, ErrorCode::CannotWrite);
        EXPECT_NE(second.error().message.find("another export"), std::string::npos);
        EXPECT_TRUE(fs::exists(folder.path() / kMark));
    }
    EXPECT_TRUE(DatasetFolder::claim(folder.path(), false));
}

TEST(DatasetFolder, TakesAFolderItMadeForNothingAwayAgain) {
    const test::TempFolder folder;
    ASSERT_TRUE(DatasetFolder::claim(folder.path() / "new", false));
    EXPECT_FALSE(fs::exists(folder.path() / "new"));
}

// What the old dataset holds is free for the new one.
TEST(DatasetFolder, CountsTheSpaceThatTheOldDatasetGivesBack) {
    const test::TempFolder folder;
    (void)folder.write("dataset.json", kOurCard);
    (void)folder.write("rgb/000000.png", std::string(64'000'000, 'x'));
    auto claimed = DatasetFolder::claim(folder.path(), false);
    ASSERT_TRUE(claimed);
    struct statvfs space {};
    ASSERT_EQ(::statvfs(folder.path().c_str(), &space), 0);
    const std::uint64_t free = std::uint64_t{space.f_bavail} * space.f_frsize;
    // Half of it as a margin: others write on this disk, too.
    EXPECT_TRUE(claimed->checkSpace(free + 32'000'000, {}));
    const Status kept = claimed->checkSpace(free + 32'000'000, {"rgb/000000.png"});
    ASSERT_FALSE(kept);
    EXPECT_EQ(kept.error().code, ErrorCode::CannotWrite);
}

}  // namespace
}  // namespace dollytrack::render
