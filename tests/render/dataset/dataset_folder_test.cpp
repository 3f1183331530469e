#include "render/dataset/folder/dataset_folder.h"

#include "render/dataset/folder/dataset_journal.h"
#include "render/encoders/modalities.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <limits>
#include <map>
#include <set>
#include <string>

namespace dollytrack::render::dataset_folder_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = ".dollytrack-export";
constexpr const char* kOurCard =
    R"({"format": "dollytrack dataset", "files": {"rgb/000007.png": ""}})";

/// The names that an export of these modalities (none: the standard ones) may write.
DatasetNames namesFor(const std::vector<std::string>& modalities = {}, int frames = 10) {
    return namesOf(*chooseModalities(modalities), {}, frames, {});
}

std::set<std::string> treeOf(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        names.insert(fs::relative(entry.path(), folder).string());
    }
    return names;
}

/// The journal of an export that was cut off.
void writeJournal(const fs::path& folder, const DatasetNames& names) {
    ASSERT_TRUE(DatasetJournal::begin(*GuardedFolder::open(folder), {{"the scene", "1"}},
                                      "a driver", names));
}

// dataset.json is a common name: images beside a dataset.json of another program must not be
// deleted.
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

TEST(DatasetFolder, KeepsAnEarlierDatasetUntilTheNewOneIsComplete) {
    const test::TempFolder folder;
    const fs::path picture = folder.write("rgb/000007.png", "old");
    const fs::path card = folder.write("dataset.json", kOurCard);
    const fs::path notes = folder.write("notes.txt", "mine");
    const fs::path mine = folder.write("rgb/000008.png", "mine");  // not listed
    {
        auto claimed = DatasetFolder::claim(folder.path(), false);
        ASSERT_TRUE(claimed);
        EXPECT_TRUE(claimed->isComplete());
        EXPECT_FALSE(claimed->checkSpace(std::numeric_limits<std::uint64_t>::max() / 2, {}));
    }
    EXPECT_FALSE(fs::exists(folder.path() / kMark));
    for (const bool ends : {false, true}) {
        auto claimed = DatasetFolder::claim(folder.path(), true);
        ASSERT_TRUE(claimed);
        ASSERT_TRUE(claimed->begin(namesFor(), {}));
        const GuardedFolder& beside = claimed->unfinished();
        ASSERT_TRUE(beside.write("rgb/000000.png", std::string_view("new")));
        EXPECT_TRUE(claimed->isComplete());
        EXPECT_TRUE(fs::exists(picture));
        EXPECT_FALSE(fs::exists(folder.path() / "rgb/000000.png"));
        if (!ends) continue;
        ASSERT_TRUE(beside.write(
            "dataset.json",
            std::string_view(
                R"({"format": "dollytrack dataset", "files": {"rgb/000000.png": ""}})")));
        const Status finished = claimed->finish();
        ASSERT_TRUE(finished) << describe(finished.error());
    }
    EXPECT_EQ(treeOf(folder.path()), (std::set<std::string>{"dataset.json", "notes.txt", "rgb",
                                                            "rgb/000000.png", "rgb/000008.png"}));
}

// An export that is killed before it begins leaves an empty journal. A claim that writes nothing
// removes it, and it does not turn a folder with other files into a dataset.
TEST(DatasetFolder, AnEmptyJournalIsNoMark) {
    const test::TempFolder folder;
    (void)folder.write(kMark, "");
    { ASSERT_TRUE(DatasetFolder::claim(folder.path(), false)); }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / kMark));
    (void)folder.write(kMark, "");
    (void)folder.write("thesis.txt", "x");
    EXPECT_FALSE(DatasetFolder::claim(folder.path(), false));
    EXPECT_EQ(treeOf(folder.path()), (std::set<std::string>{kMark, "thesis.txt"}));
}

// When an export was killed while the new dataset was moved into place, the next claim completes
// the move.
TEST(DatasetFolder, EndsAMoveThatWasCutOff) {
    const test::TempFolder folder;
    (void)folder.write("rgb/000007.png", "old");
    (void)folder.write("rgb/000000.png", "new");  // already moved
    (void)folder.write(kMark, "{}\n");
    for (const auto& [name, text] :
         std::map<std::string, std::string>{{"replaced.json", kOurCard},
                                            {"depth/000000.png", "new"},
                                            {"dataset.json", R"({"format": "dollytrack dataset",
                                  "files": {"rgb/000000.png": "", "depth/000000.png": ""}})"}}) {
        (void)folder.write(".dollytrack-new/" + name, text);
    }
    const auto claimed = DatasetFolder::claim(folder.path(), false);
    ASSERT_TRUE(claimed) << describe(claimed.error());
    EXPECT_TRUE(claimed->isComplete());
    EXPECT_EQ(treeOf(folder.path()),
              (std::set<std::string>{kMark, "dataset.json", "depth", "depth/000000.png", "rgb",
                                     "rgb/000000.png"}));
}

TEST(DatasetFolder, RemovesWhatAKilledExportLeftButForWhatIsKept) {
    const test::TempFolder folder;
    for (const char* name : {"rgb/000000.png", "rgb/000001.png", "rgb/000001.png.tmp.123",
                             "depth/000000.png", "semantic/000000.png", "dataset.json.tmp.77",
                             "rgb/mine.png", "rgb/000010.png", "albedo/000000.png"}) {
        (void)folder.write(name, "x");
    }
    writeJournal(folder.path(), namesFor());
    auto claimed = DatasetFolder::claim(folder.path(), false);
    ASSERT_TRUE(claimed);
    ASSERT_TRUE(claimed->begin(namesFor({"rgb", "instance"}), {"rgb/000000.png"}));
    ASSERT_TRUE(claimed->makeFolders(namesFor({"rgb", "instance"})));
    // The killed export had ten frames and no albedo, so an eleventh frame and albedo files are not
    // its own.
    EXPECT_EQ(treeOf(folder.path()),
              (std::set<std::string>{kMark, "albedo", "albedo/000000.png", "instance", "rgb",
                                     "rgb/000000.png", "rgb/000010.png", "rgb/mine.png"}));
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
    ASSERT_TRUE(DatasetFolder::claim(folder.path() / "a/b/new/", false));
    EXPECT_FALSE(fs::exists(folder.path() / "a"));
}

// A mark that stays behind would make a folder of other files look like an unfinished dataset.
TEST(DatasetFolder, LeavesNothingWhereBeginRefuses) {
    const test::TempFolder folder;
    (void)folder.write("thesis.txt", "mine");
    (void)folder.write("pictures/1.png", "mine");
    fs::create_directory_symlink("pictures", folder.path() / "rgb");
    const std::set<std::string> before = treeOf(folder.path());
    {
        auto claimed = DatasetFolder::claim(folder.path(), true);
        ASSERT_TRUE(claimed);
        EXPECT_FALSE(claimed->begin(namesFor(), {}));
    }
    EXPECT_EQ(treeOf(folder.path()), before);
    EXPECT_FALSE(DatasetFolder::claim(folder.path(), false));
}

TEST(DatasetFolder, LeavesNothingUnlessItMadeTheFolders) {
    const test::TempFolder folder;
    (void)folder.write("rgb/mine.png", "mine");
    for (const bool complete : {false, true}) {
        if (complete) {
            (void)folder.write("dataset.json", kOurCard);
            (void)folder.write("rgb/000007.png", "old");
        }
        const std::set<std::string> before = treeOf(folder.path());
        {
            auto claimed = DatasetFolder::claim(folder.path(), true);
            ASSERT_TRUE(claimed);
            ASSERT_TRUE(claimed->begin(namesFor(), {}));
            EXPECT_NE(treeOf(folder.path()), before);
            EXPECT_FALSE(claimed->makeFolders(namesFor()));  // the journal is empty
        }
        EXPECT_EQ(treeOf(folder.path()), before);
    }
    {
        auto claimed = DatasetFolder::claim(folder.path(), true);
        ASSERT_TRUE(claimed);
        ASSERT_TRUE(claimed->begin(namesFor(), {}));
        writeJournal(folder.path(), namesFor());
        ASSERT_TRUE(claimed->makeFolders(namesFor()));
    }
    EXPECT_TRUE(fs::exists(folder.path() / kMark));
    EXPECT_TRUE(fs::exists(folder.path() / ".dollytrack-new/rgb"));
}

TEST(DatasetFolder, LeavesNothingWhereAFolderWithinAnotherFails) {
    const test::TempFolder folder;
    DatasetNames names = namesFor();
    names.folders.insert("labels");
    names.folders.insert("lists/of/train");
    names.folders.insert("lists/of/" + std::string(300, 'x'));
    {
        auto claimed = DatasetFolder::claim(folder.path(), false);
        ASSERT_TRUE(claimed);
        ASSERT_TRUE(claimed->begin(names, {}));
        writeJournal(folder.path(), names);
        EXPECT_FALSE(claimed->makeFolders(names));
        EXPECT_TRUE(fs::exists(folder.path() / "lists/of/train"));
    }
    EXPECT_EQ(treeOf(folder.path()), std::set<std::string>{});
}

// A killed export runs no destructor. Wherever it is killed, the next one must accept the folder.
TEST(DatasetFolder, CanBeClaimedAgainAfterAKillAtAnyStep) {
    for (const bool complete : {false, true}) {
        for (int steps = 0; steps <= 3; ++steps) {
            const test::TempFolder folder;
            if (complete) (void)folder.write("dataset.json", kOurCard);
            const pid_t child = ::fork();
            if (child == 0) {
                auto claimed = DatasetFolder::claim(folder.path(), complete);
                bool good = claimed.has_value();
                if (steps > 0) good = good && claimed->begin(namesFor(), {});
                if (steps > 1) writeJournal(folder.path(), namesFor());
                if (steps > 2) good = good && claimed->makeFolders(namesFor());
                ::_exit(good ? 0 : 1);
            }
            int how = 0;
            ASSERT_EQ(::waitpid(child, &how, 0), child);
            ASSERT_EQ(how, 0);
            const auto again = DatasetFolder::claim(folder.path(), false);
            ASSERT_TRUE(again) << describe(again.error());
            EXPECT_EQ(again->isComplete(), complete);
        }
    }
}

// The space of an unfinished dataset is free for the new one; a complete dataset is kept until
// the new one is finished.
TEST(DatasetFolder, CountsTheSpaceThatIsGivenBack) {
    const test::TempFolder folder;
    (void)folder.write("rgb/000000.png", std::string(64'000'000, 'x'));
    writeJournal(folder.path(), namesFor());
    struct statvfs space {};
    ASSERT_EQ(::statvfs(folder.path().c_str(), &space), 0);
    const std::uint64_t free = std::uint64_t{space.f_bavail} * space.f_frsize;
    {
        auto claimed = DatasetFolder::claim(folder.path(), false);
        ASSERT_TRUE(claimed);
        // Half of the file's size is a margin, since other programs write to this disk, too.
        EXPECT_TRUE(claimed->checkSpace(free + 32'000'000, {}));
        const Status kept = claimed->checkSpace(free + 32'000'000, {"rgb/000000.png"});
        ASSERT_FALSE(kept);
        EXPECT_EQ(kept.error().code, ErrorCode::CannotWrite);
    }
    (void)folder.write("dataset.json", kOurCard);
    auto claimed = DatasetFolder::claim(folder.path(), true);
    ASSERT_TRUE(claimed);
    EXPECT_FALSE(claimed->checkSpace(free + 32'000'000, {}));
}

}  // namespace
}  // namespace dollytrack::render::dataset_folder_test
