#include "render/dataset/folder/dataset_journal.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace dollytrack::render::dataset_journal_test {
namespace {

namespace fs = std::filesystem;

JournalEntry entryOf(int index) {
    JournalEntry entry;
    entry.index = index;
    entry.sha256s = {{"rgb/" + std::to_string(index), "5a"}, {"depth/x", "77"}};
    entry.masks = {{3, {5, 2, 5}, 2, {1, 2, 1, 2}}, {9, {0, 12}, 12, {0, 0, 4, 3}}};
    // Numbers without a short decimal form: reading must return exactly the same values.
    entry.views = {{3, index, 1.0 / 3.0, 123.4567890123456789, 0.1 + 0.2, 1e-17 / 7.0}};
    entry.well_shown = {3, 9};
    if (index > 0) entry.quality = PictureQuality::Flat;
    return entry;
}

class Journal : public testing::Test {
  protected:
    void write(int count) {
        auto journal = DatasetJournal::begin(guarded_, identity_, "a driver", {});
        ASSERT_TRUE(journal);
        for (int i = 0; i < count; ++i) ASSERT_TRUE(journal->append(entryOf(i)));
    }
    [[nodiscard]] std::string bytes() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void replace(const std::string& bytes) const {
        std::ofstream(path_, std::ios::binary) << bytes;
    }

    test::TempFolder folder_;
    fs::path path_ = folder_.path() / kJournalFile;
    GuardedFolder guarded_ = *GuardedFolder::open(folder_.path());
    DatasetIdentity identity_ = {{"the scene", "1"}, {"the camera", "640 480"}};
};

TEST_F(Journal, GivesBackWhatWasWritten) {
    write(3);
    const JournalContents contents = readJournal(guarded_);
    ASSERT_TRUE(contents.identity);
    EXPECT_EQ(*contents.identity, identity_);
    EXPECT_EQ(contents.drawn_by, "a driver");
    ASSERT_EQ(contents.entries.size(), 3U);
    EXPECT_EQ(contents.whole_bytes, fs::file_size(path_));
    const JournalEntry expected = entryOf(2);
    const JournalEntry& entry = contents.entries.at(2);
    EXPECT_EQ(entry.sha256s, expected.sha256s);
    EXPECT_EQ(entry.well_shown, expected.well_shown);
    EXPECT_EQ(entry.quality, PictureQuality::Flat);
    EXPECT_FALSE(contents.entries.at(0).quality);
    ASSERT_EQ(entry.masks.size(), 2U);
    EXPECT_EQ(entry.masks[1].counts, expected.masks[1].counts);
    EXPECT_EQ(entry.masks[0].bbox, expected.masks[0].bbox);
    EXPECT_EQ(entry.masks[0].area, 2U);
    ASSERT_EQ(entry.views.size(), 1U);
    EXPECT_EQ(entry.views[0].object_id, 3);
    EXPECT_EQ(entry.views[0].frame, 2);
    EXPECT_EQ(entry.views[0].visible_fraction, expected.views[0].visible_fraction);
    EXPECT_EQ(entry.views[0].visible_px, expected.views[0].visible_px);
    EXPECT_EQ(entry.views[0].box_share, expected.views[0].box_share);
    EXPECT_EQ(entry.views[0].mask_share, expected.views[0].mask_share);
}

// A journal may come from anywhere, and its quality values are used as a table index.
TEST_F(Journal, AnEntryOfAnUnknownQualityIsNone) {
    write(1);
    auto journal = DatasetJournal::resume(guarded_, readJournal(guarded_));
    ASSERT_TRUE(journal);
    for (const int quality : {-1, 4, 1'000'000}) {
        JournalEntry entry = entryOf(1);
        entry.quality = static_cast<PictureQuality>(quality);
        ASSERT_TRUE(journal->append(entry));
        EXPECT_EQ(readJournal(guarded_).entries.size(), 1U) << quality;
    }
    ASSERT_TRUE(journal->append(entryOf(1)));
    EXPECT_EQ(readJournal(guarded_).entries.size(), 2U);
}

// A kill may come after any byte.
TEST_F(Journal, SurvivesBeingCutOffAnywhere) {
    write(2);
    const std::string whole = bytes();
    const std::size_t header = whole.find('\n') + 1;
    const std::size_t first = whole.find('\n', header) + 1;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        replace(whole.substr(0, length));
        const JournalContents contents = readJournal(guarded_);
        EXPECT_EQ(contents.identity.has_value(), length >= header) << length;
        EXPECT_EQ(contents.entries.size(), length >= first ? 1U : 0U) << length;
        if (length < header) continue;
        auto journal = DatasetJournal::resume(guarded_, contents);
        ASSERT_TRUE(journal);
        ASSERT_TRUE(journal->append(entryOf(1)));
        EXPECT_EQ(readJournal(guarded_).entries.count(1), 1U) << length;
    }
}

TEST_F(Journal, DropsDamagedLinesAndNoOthers) {
    write(3);
    const std::string whole = bytes();
    const std::size_t middle = whole.find("\"frame\":1");
    ASSERT_NE(middle, std::string::npos);
    std::string damaged = whole;
    damaged[middle + 8] = '2';  // still JSON, but of another frame
    replace(damaged);
    const JournalContents contents = readJournal(guarded_);
    ASSERT_TRUE(contents.identity);
    EXPECT_EQ(contents.entries.count(0), 1U);
    EXPECT_EQ(contents.entries.count(1), 0U);
    EXPECT_EQ(contents.entries.at(2).sha256s, entryOf(2).sha256s);
}

TEST_F(Journal, TheLaterLineOfAFrameHolds) {
    write(1);
    auto journal = DatasetJournal::resume(guarded_, readJournal(guarded_));
    ASSERT_TRUE(journal);
    JournalEntry again = entryOf(0);
    again.sha256s = {{"rgb/0", "new"}};
    ASSERT_TRUE(journal->append(again));
    EXPECT_EQ(readJournal(guarded_).entries.at(0).sha256s, again.sha256s);
}

TEST_F(Journal, WhatIsNoJournalHoldsNothing) {
    EXPECT_FALSE(readJournal(guarded_).identity);
    for (const char* text : {"", "an export is running or was cut off\n", "{}\n[]\n\n"}) {
        replace(text);
        EXPECT_FALSE(readJournal(guarded_).identity) << text;
        EXPECT_TRUE(readJournal(guarded_).entries.empty()) << text;
    }
}

TEST(DatasetIdentity, NamesWhatDiffers) {
    const DatasetIdentity a = {{"the scene", "1"}, {"the camera", "2"}, {"old", "3"}};
    EXPECT_EQ(differences(a, a), "");
    EXPECT_EQ(differences(a, {{"the scene", "1"}, {"the camera", "9"}, {"old", "3"}}),
              "the camera");
    EXPECT_EQ(differences(a, {{"the scene", "5"}, {"the camera", "2"}, {"new", "3"}}),
              "new, old, the scene");
}

}  // namespace
}  // namespace dollytrack::render::dataset_journal_test
