#include "engine/core/log.h"
#include "engine/core/fold_repeats.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

namespace dollytrack::log_test {

TEST(Log, FoldsRepeatsIntoOneRecordWithACount) {
    std::vector<log::Record> records;
    const log::Sink before = log::setSink([&](const log::Record& r) { records.push_back(r); });
    log::warn("import", "no texture");
    log::warn("import", "no texture");
    log::warn("import", "no texture");
    log::info("import", "done");
    log::debug("import", "below the level");
    log::setSink(before);

    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(records[0].repeats, 1);
    EXPECT_EQ(records[1].message, "no texture");
    EXPECT_EQ(records[1].repeats, 3);
    EXPECT_EQ(records[2].message, "done");
}

TEST(Log, MessagesReachNoSinkWithControlCharacters) {
    std::vector<log::Record> records;
    const log::Sink before = log::setSink([&](const log::Record& r) { records.push_back(r); });
    log::warn("import", "no \x1B[31mtexture\x07\r\n");
    log::setSink(before);
    ASSERT_EQ(records.size(), 1U);
    EXPECT_EQ(records[0].message, "no [31mtexture");
}

TEST(FoldRepeats, CountsWhatDiffersInNamesAndNumbersAlone) {
    std::vector<std::string> messages = {"one of its kind"};
    for (int i = 0; i < 100; ++i) {
        messages.push_back("there is no node \"node " + std::to_string(i) + "\"");
        messages.push_back(fmt::format("'{}' has {} m", std::string(1 + i % 3, 'x'), i));
    }
    const std::vector<std::string> folded = foldRepeats(messages, 3);
    ASSERT_EQ(folded.size(), 7U);
    EXPECT_EQ(folded[0], "one of its kind");
    EXPECT_EQ(folded[1], "there is no node \"node 0\"");
    EXPECT_EQ(folded[5], "there is no node \"node 2\" (and 97 more like this)");
    EXPECT_EQ(folded[6], "'xxx' has 2 m (and 97 more like this)");
    EXPECT_EQ(foldRepeats(folded, 3), folded);
}

}  // namespace dollytrack::log_test
